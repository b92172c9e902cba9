//! Samples of examples.

/// What to write, for a task whose stage has no file yet.
pub fn sample(task: &str) -> &'static str {
    match task {
        "part1.task1" => {
            "[[pixel]]\nfilm = [2, 2]       # width and height\npixel = [0, 0]      # column and row, from the bottom left\n\
             expected = [0.25, 0.25]     # the point of the film for its only sample, from [0, 0] to [1, 1]\n"
        }
        "part1.task2" => {
            "[[camera]]\nh_fov = 90\nv_fov = 90\nsensor = [1, 0.5]    # from [0, 0], the bottom left, to [1, 1]\n\
             # axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] (right, up, backward) if they are not written\nexpected = [0.707, 0, -0.707]    # the direction, of length 1\n"
        }
        "part4.task1" => {
            "[[reflect]]\nwo = [0.6, 0, 0.8]\nexpected = [-0.6, 0, 0.8]\n\n\
             [[refract]]\nwo = [0.6, 0, -0.8]\nior = 2\nexpected = \"none\"    # or the direction, such as [-0.3, 0, -0.954]\n"
        }
        "part1.task3" => {
            "[[triangle]]\np0 = [0, 0, 0]\np1 = [4, 0, 0]\np2 = [0, 4, 0]\no = [1, 1, -1]\nd = [0, 0, 1]\n\
             # min_t = 0 and max_t = inf if they are not written\nexpected = 1        # the t of the hit, or \"miss\"\n"
        }
        "part1.task4" => {
            "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\no = [0, 0, -3]\nd = [0, 0, 1]\n\
             # min_t = 0 and max_t = inf if they are not written\nexpected = 2        # the t of the hit, or \"miss\"\n"
        }
        _ => {
            "[[box]]\nmin = [0, 0, 0]\nmax = [1, 1, 1]\no = [0.5, 0.5, -1]\nd = [0, 0, 1]\n\
             # min_t = 0 and max_t = inf if they are not written\nexpected = [1, 2]   # from where to where the ray is inside, or \"miss\"\n"
        }
    }
}
