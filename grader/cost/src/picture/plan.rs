//! What is compared: five questions, each with ways to render the same picture.

/// A question.
#[derive(Clone, Debug)]
pub struct Plan {
    /// In a few words.
    pub title: &'static str,
    /// A file of `scenes/dae`.
    pub scene: &'static str,
    /// Pixels across and up: few, so that many samples cost little.
    pub film: [u32; 2],
    /// The part that is rendered: left, bottom, width, height. Lit pictures leave out the lamp: where it ends in a pixel,
    /// its brightness would drown every other error.
    pub cell: [u32; 4],
    /// Pictures a point.
    pub seeds: u32,
    /// Flags of each of the two converged pictures.
    pub converged: String,
    /// Whether the ways aim at an equal share of error in every pixel.
    pub is_relative: bool,
    /// The ways.
    pub ways: Vec<Way>,
}

/// One way to render.
#[derive(Clone, Debug)]
pub struct Way {
    /// Its name.
    pub name: String,
    /// The flags that choose it.
    pub flags: String,
    /// The flags that say how many samples, and how many these are if each pixel takes them all.
    pub steps: Vec<(String, u32)>,
}

impl Way {
    fn new(name: impl Into<String>, flags: impl Into<String>, samples: &[u32]) -> Way {
        Way {
            name: name.into(),
            flags: flags.into(),
            steps: samples.iter().map(|n| (format!("-s {n}"), *n)).collect(),
        }
    }
}

/// All questions; `quick` answers them with fewer samples and smaller pictures.
pub fn all(quick: bool) -> Vec<Plan> {
    let lamp = direct_light(quick, "direct light from a lamp", "cornell_spheres.dae");
    let sky = direct_light(quick, "direct light from the sky", "stairs_sky.dae");
    vec![edges(quick), lamp, sky, depth(quick), adaptive(quick)]
}

/// The lower three quarters of a film.
fn without_lamp([w, h]: [u32; 2]) -> [u32; 4] {
    [0, 0, w, h * 3 / 4]
}

/// Where samples lie in a pixel. Normal shading has nothing else that is random.
fn edges(quick: bool) -> Plan {
    let samples: &[u32] = if quick {
        &[1, 4, 16, 64]
    } else {
        &[1, 4, 16, 64, 256]
    };
    let way = |name, sampler| {
        Way::new(
            name,
            format!("--shade normals --sampler {sampler}"),
            samples,
        )
    };
    let [w, h] = if quick { [32, 24] } else { [64, 48] };
    Plan {
        title: "samples in a pixel",
        scene: "spheres.dae",
        film: [w, h],
        cell: [0, 0, w, h],
        seeds: if quick { 3 } else { 5 },
        converged: format!(
            "--shade normals --sampler sobol -s {}",
            if quick { 512 } else { 2048 }
        ),
        is_relative: false,
        ways: vec![
            way("independent", "independent"),
            way("stratified", "stratified"),
            way("Sobol", "sobol"),
        ],
    }
}

/// How direct light is found.
fn direct_light(quick: bool, title: &'static str, scene: &'static str) -> Plan {
    let samples: &[u32] = if quick {
        &[4, 16, 64]
    } else {
        &[4, 16, 64, 256]
    };
    let way = |name, flags| Way::new(name, format!("--shade lit -m 1 {flags}"), samples);
    let film = if quick { [24, 18] } else { [40, 30] };
    Plan {
        title,
        scene,
        film,
        cell: without_lamp(film),
        seeds: 3,
        converged: format!(
            "--shade lit -m 1 --sampler sobol -s {}",
            if quick { 512 } else { 2048 }
        ),
        is_relative: false,
        ways: vec![
            way("uniform hemisphere", "-H --sampler independent"),
            way("light sampling", "--sampler independent"),
            way("MIS", "--mis --sampler independent"),
            way("MIS, Sobol", "--mis --sampler sobol"),
        ],
    }
}

/// How far light is followed. What a depth leaves out does not get less with more samples.
fn depth(quick: bool) -> Plan {
    let samples: &[u32] = if quick {
        &[4, 16, 64]
    } else {
        &[4, 16, 64, 256]
    };
    let depths: &[u32] = if quick { &[1, 2, 5] } else { &[1, 2, 3, 5, 8] };
    let way = |depth: &u32| {
        Way::new(
            format!("depth {depth}"),
            format!("--shade lit -m {depth}"),
            samples,
        )
    };
    let film = if quick { [20, 16] } else { [32, 24] };
    Plan {
        title: "ray depth",
        scene: "cornell_spheres.dae",
        film,
        cell: without_lamp(film),
        seeds: 3,
        converged: format!(
            "--shade lit -m 64 --sampler sobol -s {}",
            if quick { 256 } else { 1024 }
        ),
        is_relative: false,
        ways: depths.iter().map(way).collect(),
    }
}

/// Samples where they are needed, against as many everywhere.
fn adaptive(quick: bool) -> Plan {
    let most = if quick { 1024 } else { 2048 };
    let tolerances: &[f64] = if quick {
        &[0.2, 0.1]
    } else {
        &[0.2, 0.1, 0.05]
    };
    let step = |tolerance: &f64| (format!("-s {most} -a 64 {tolerance}"), most);
    let film = if quick { [12, 9] } else { [32, 24] };
    Plan {
        title: "adaptive sampling",
        scene: "cornell_spheres.dae",
        film,
        cell: without_lamp(film),
        seeds: 3,
        converged: format!(
            "--shade lit -m 1 --sampler sobol -s {}",
            if quick { 2048 } else { 4096 }
        ),
        is_relative: true,
        ways: vec![
            Way::new(
                "fixed",
                "--shade lit -m 1",
                if quick {
                    &[256, 1024]
                } else {
                    &[256, 512, 1024]
                },
            ),
            Way {
                name: "adaptive".into(),
                flags: "--shade lit -m 1".into(),
                steps: tolerances.iter().map(step).collect(),
            },
        ],
    }
}
