//! The experiments: six comparisons of methods that render the same picture.

/// One experiment.
#[derive(Clone, Debug)]
pub struct ExperimentPlan {
    /// A short title.
    pub title: &'static str,
    /// A file in `scenes/dae`.
    pub scene: &'static str,
    /// Width and height in pixels: small, so that many samples are cheap.
    pub film: [u32; 2],
    /// The part that is rendered: left, bottom, width, height. Lit pictures leave out the light
    /// source: in pixels at its border the error of its brightness would exceed all other errors.
    pub cell: [u32; 4],
    /// Pictures per point of a curve.
    pub seeds: u32,
    /// Flags of the two converged pictures.
    pub converged: String,
    /// Whether the methods aim at an equal relative error in every pixel.
    pub is_relative: bool,
    /// What the axis of samples counts.
    pub samples_are: &'static str,
    /// The compared methods.
    pub methods: Vec<RenderMethod>,
}

/// A method of rendering.
#[derive(Clone, Debug)]
pub struct RenderMethod {
    /// The name.
    pub name: String,
    /// The flags that select it.
    pub flags: String,
    /// For each point of the curve: the flags for the number of samples, and the samples per pixel
    /// if every pixel takes them all.
    pub steps: Vec<(String, u32)>,
}

impl RenderMethod {
    fn new(name: impl Into<String>, flags: impl Into<String>, samples: &[u32]) -> RenderMethod {
        RenderMethod {
            name: name.into(),
            flags: flags.into(),
            steps: samples.iter().map(|n| (format!("-s {n}"), *n)).collect(),
        }
    }
}

/// Returns all experiments; with `quick`, with fewer samples and smaller pictures.
pub fn all(quick: bool) -> Vec<ExperimentPlan> {
    let lamp = direct_light(quick, "direct light from a lamp", "cornell_spheres.dae");
    let sky = direct_light(quick, "direct light from the sky", "stairs_sky.dae");
    vec![
        edges(quick),
        lamp,
        sky,
        depth(quick),
        clamp(quick),
        adaptive(quick),
    ]
}

/// What a quick run takes, or else a full one.
fn pick<T>(quick: bool, of_quick: T, of_full: T) -> T {
    if quick { of_quick } else { of_full }
}

/// Returns the lower three quarters of the picture.
fn without_lamp([w, h]: [u32; 2]) -> [u32; 4] {
    [0, 0, w, h * 3 / 4]
}

/// An experiment without methods: lit pictures without the lamp, in the lower part of `film`. The
/// converged picture has paths of `depth` bounces and this many samples in a pixel.
fn lit(
    title: &'static str,
    scene: &'static str,
    film: [u32; 2],
    [depth, samples]: [u32; 2],
) -> ExperimentPlan {
    ExperimentPlan {
        title,
        scene,
        film,
        cell: without_lamp(film),
        seeds: 3,
        converged: format!("--shade lit -m {depth} --sampler sobol -s {samples}"),
        is_relative: false,
        samples_are: "camera rays per pixel",
        methods: Vec::new(),
    }
}

/// Sampling of the pixel area. With normal shading nothing else is random.
fn edges(quick: bool) -> ExperimentPlan {
    let samples: &[u32] = pick(quick, &[1, 4, 16, 64], &[1, 4, 16, 64, 256]);
    let method = |name, sampler| {
        RenderMethod::new(
            name,
            format!("--shade normals --sampler {sampler}"),
            samples,
        )
    };
    let [w, h] = pick(quick, [32, 24], [64, 48]);
    ExperimentPlan {
        title: "samples in a pixel",
        scene: "spheres.dae",
        film: [w, h],
        cell: [0, 0, w, h],
        seeds: pick(quick, 3, 5),
        converged: format!(
            "--shade normals --sampler sobol -s {}",
            pick(quick, 512, 2048)
        ),
        is_relative: false,
        samples_are: "positions in a pixel",
        methods: vec![
            method("independent", "independent"),
            method("stratified", "stratified"),
            method("Sobol", "sobol"),
        ],
    }
}

/// Estimators of direct light.
fn direct_light(quick: bool, title: &'static str, scene: &'static str) -> ExperimentPlan {
    let samples: &[u32] = pick(quick, &[4, 16, 64], &[4, 16, 64, 256]);
    let method =
        |name, flags| RenderMethod::new(name, format!("--shade lit -m 1 {flags}"), samples);
    let film = pick(quick, [24, 18], [40, 30]);
    ExperimentPlan {
        samples_are: "camera rays per pixel, one light sample each",
        methods: vec![
            method("uniform hemisphere", "-H --sampler independent"),
            method("light sampling", "--sampler independent"),
            method("MIS", "--mis --sampler independent"),
            method("MIS, Sobol", "--mis --sampler sobol"),
        ],
        ..lit(title, scene, film, [1, pick(quick, 512, 2048)])
    }
}

/// Ray depth. The light that a depth leaves out is a bias, which more samples do not reduce.
fn depth(quick: bool) -> ExperimentPlan {
    let samples: &[u32] = pick(quick, &[4, 16, 64], &[4, 16, 64, 256]);
    let depths: &[u32] = pick(quick, &[1, 2, 5], &[1, 2, 3, 5, 8]);
    let method = |depth: &u32| {
        RenderMethod::new(
            format!("depth {depth}"),
            format!("--shade lit -m {depth} --sampler sobol --roulette 1"),
            samples,
        )
    };
    let film = pick(quick, [20, 16], [32, 24]);
    let converged = [64, pick(quick, 256, 1024)];
    ExperimentPlan {
        methods: depths.iter().map(method).collect(),
        ..lit("ray depth", "cornell_spheres.dae", film, converged)
    }
}

/// Clamping indirect light: less noise, and a bias. A clamped picture takes as long as any other,
/// so rows of equal samples compare the limits at equal time.
fn clamp(quick: bool) -> ExperimentPlan {
    let samples: &[u32] = pick(quick, &[16, 64], &[4, 16, 64, 256]);
    let limits: &[f64] = pick(quick, &[3.0, 0.3], &[10.0, 3.0, 1.0, 0.3, 0.1]);
    let flags = "--shade lit -m 8 --sampler independent --roulette 1";
    let mut methods = vec![RenderMethod::new("no clamp", flags, samples)];
    methods.extend(limits.iter().map(|limit| {
        let flags = format!("{flags} --clamp {limit}");
        RenderMethod::new(format!("clamp {limit}"), flags, samples)
    }));
    let film = pick(quick, [20, 16], [32, 24]);
    let converged = [8, pick(quick, 2048, 8192)];
    ExperimentPlan {
        seeds: pick(quick, 3, 8),
        methods,
        ..lit("fireflies", "cornell_mirror_glass.dae", film, converged)
    }
}

/// Adaptive sampling against the same number of samples in every pixel.
fn adaptive(quick: bool) -> ExperimentPlan {
    let most = pick(quick, 1024, 2048);
    let tolerances: &[f64] = pick(quick, &[0.2, 0.1], &[0.2, 0.1, 0.05]);
    let step = |tolerance: &f64| (format!("-s {most} -a 64 {tolerance}"), most);
    let film = pick(quick, [12, 9], [32, 24]);
    let converged = [1, pick(quick, 2048, 4096)];
    ExperimentPlan {
        is_relative: true,
        samples_are: "mean camera rays per pixel",
        methods: vec![
            RenderMethod::new(
                "fixed",
                "--shade lit -m 1",
                pick(quick, &[256, 1024], &[256, 512, 1024]),
            ),
            RenderMethod {
                name: "adaptive".into(),
                flags: "--shade lit -m 1".into(),
                steps: tolerances.iter().map(step).collect(),
            },
        ],
        ..lit("adaptive sampling", "cornell_spheres.dae", film, converged)
    }
}
