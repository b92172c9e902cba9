//! Calls a pasted function from a hole: arguments by their types, results in the form that the hole
//! returns.

use super::items::Function;

/// What a type means, whatever crate it is of.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Meaning {
    /// Three numbers: a vector, a colour.
    Triple,
    /// Two numbers.
    Pair,
    /// Anything else, by its name without path and reference.
    Other(String),
}

fn meaning(of: &str) -> Meaning {
    let plain = plain(of);
    match plain.as_str() {
        "Xyz" | "Vec3" | "DVec3" | "Spectrum" | "[f64;3]" => Meaning::Triple,
        "Vec2" | "[f64;2]" => Meaning::Pair,
        _ => Meaning::Other(plain),
    }
}

/// A type without references, lifetimes, paths and blanks.
fn plain(of: &str) -> String {
    let compact: String = of.split_whitespace().collect::<Vec<_>>().join(" ");
    let compact = compact
        .trim_start_matches('&')
        .trim_start_matches("mut ")
        .replace("&'a ", "")
        .replace("<'_>", "")
        .replace("<'a>", "");
    let last = match compact.contains(['<', '(', '[']) {
        true => compact.as_str(),
        false => compact.rsplit("::").next().unwrap_or(&compact),
    };
    last.replace(' ', "")
}

/// The function of a task: its name, parameters and result.
#[derive(Clone, Debug)]
pub(super) struct Hole {
    pub(super) name: String,
    pub(super) parameters: Vec<(String, String)>,
    pub(super) returns: String,
}

/// The expressions that call `function` from the body of `hole`; empty if its types do not fit.
pub(super) fn calls(hole: &Hole, function: &Function, has_unit_self: bool) -> Vec<String> {
    let mut arguments: Vec<Vec<(String, Vec<usize>)>> = Vec::new();
    for (name, of) in &function.parameters {
        let options = match name.as_str() {
            "self" if has_unit_self => vec![(of.clone(), Vec::new())],
            _ => argument(hole, name, of),
        };
        if options.is_empty() {
            return Vec::new();
        }
        arguments.push(options);
    }
    let mut lists: Vec<(Vec<String>, Vec<usize>)> = vec![(Vec::new(), Vec::new())];
    for options in &arguments {
        let longer = lists.iter().flat_map(|(list, used)| {
            let is_fresh = |i: &usize| *i == MADE || !used.contains(i);
            let fresh = options
                .iter()
                .filter(move |(_, uses)| uses.iter().all(is_fresh));
            fresh.map(|(text, uses)| {
                let list = [list.clone(), vec![text.clone()]].concat();
                (list, [used.clone(), uses.clone()].concat())
            })
        });
        lists = longer.take(MOST_ORDERS).collect();
    }
    let is_method = function
        .parameters
        .first()
        .is_some_and(|(name, _)| name == "self");
    let calls = lists
        .iter()
        .filter(|(_, used)| !used.is_empty())
        .map(|(list, _)| {
            let method = function.path.rsplit("::").next().unwrap_or_default();
            match is_method {
                true => format!("{}.{method}({})", list[0], list[1..].join(", ")),
                false => format!("{}({})", function.path, list.join(", ")),
            }
        });
    calls
        .filter_map(|call| result(hole, &call, &function.returns))
        .collect()
}

/// In place of the number of a parameter: an argument that is made of several.
const MADE: usize = usize::MAX;

/// The most orders of arguments of one type that are tried.
const MOST_ORDERS: usize = 6;

/// The expressions of the hole's parameters for a parameter `name` of the type `of`, that of the
/// same name first, and which parameters each uses.
fn argument(hole: &Hole, name: &str, of: &str) -> Vec<(String, Vec<usize>)> {
    let by_reference = if of.trim_start().starts_with('&') {
        "&"
    } else {
        ""
    };
    let wanted = meaning(of);
    let find = |name: &str| hole.parameters.iter().position(|(other, _)| other == name);
    // Types of the grader that are made of parameters.
    let made = match plain(of).as_str() {
        "LambertProbe" => {
            let field = |name: &str, of: &str| match find(name) {
                Some(_) => format!("{name}: triple({name})"),
                None => format!("{name}: {of}"),
            };
            let u = match find("u") {
                Some(_) => "u: [u.x, u.y]".to_string(),
                None => "u: [0.5; 2]".to_string(),
            };
            Some(format!(
                "LambertProbe {{ {}, {}, {}, {u} }}",
                field("reflectance", "[0.5; 3]"),
                field("wo", "[0.0, 0.0, 1.0]"),
                field("wi", "[0.0, 0.0, 1.0]"),
            ))
        }
        "Material" => find("reflectance")
            .map(|_| "kit::Material::Diffuse { reflectance: Spectrum::from(triple(reflectance)) }".into()),
        "SpecularCall" => Some(match hole.name.as_str() {
            "fresnel_dielectric" => "SpecularCall::Fresnel { cos_i, eta }".into(),
            "reflect" => "SpecularCall::Reflect { wo: triple(wo) }".into(),
            "refract" => "SpecularCall::Refract { wo: triple(wo), ior }".into(),
            "mirror_sample" => {
                "SpecularCall::Mirror { reflectance: triple(reflectance), wo: triple(wo) }".into()
            }
            "refraction_sample" => "SpecularCall::Refraction { transmittance: triple(transmittance), ior, wo: triple(wo) }".into(),
            "glass_sample" => "SpecularCall::Glass { reflectance: triple(reflectance), transmittance: triple(transmittance), \
                 ior, wo: triple(wo), choice }".into(),
            _ => return Vec::new(),
        }),
        "StopCall" => find("tolerance").map(|_| {
            "StopCall { runs: vec![(samples.count() as u32, samples.mean())], tolerance, rule: true }".into()
        }),
        "Tier" => Some("Tier::Core".into()),
        _ => None,
    };
    if let Some(made) = made {
        return vec![(format!("{by_reference}{made}"), vec![MADE])];
    }
    let mut options: Vec<(String, Vec<usize>)> = Vec::new();
    for (i, (own, own_type)) in hole.parameters.iter().enumerate() {
        let given = meaning(own_type);
        let text = match (&wanted, &given) {
            (Meaning::Triple, Meaning::Triple) => match plain(of).as_str() {
                "Xyz" | "[f64;3]" => format!("{by_reference}triple({own})"),
                "Spectrum" => format!("{by_reference}Spectrum::from(triple({own}))"),
                _ => format!("{by_reference}Vec3::from(triple({own}))"),
            },
            (Meaning::Pair, Meaning::Pair) => match plain(of).as_str() {
                "Vec2" => format!("{by_reference}Vec2::from(pair({own}))"),
                _ => format!("{by_reference}pair({own})"),
            },
            (Meaning::Other(wanted), Meaning::Other(given)) if wanted == given => {
                match (by_reference, own_type.starts_with('&')) {
                    ("", true) => format!("Same::same({own})"),
                    ("&", true) => format!("&Same::same({own})"),
                    (_, false) => format!("{by_reference}{own}"),
                    _ => unreachable!("a type is a reference or not"),
                }
            }
            (Meaning::Other(wanted), Meaning::Triple) if wanted == "f64" => {
                format!("triple({own})[2]")
            }
            _ => continue,
        };
        options.push((text, vec![i]));
    }
    options.sort_by_key(|(_, uses)| hole.parameters[uses[0]].0 != name);
    options
}

/// Expressions for a hole without any code behind them, constants and its own arguments: what the
/// glue alone earns.
pub(super) fn constants(hole: &Hole) -> Vec<String> {
    let constants = [
        ("[0.0, 0.0, 1.0]", "[f64; 3]"),
        ("0.0", "f64"),
        ("1.0", "f64"),
        ("false", "bool"),
        ("true", "bool"),
        ("None::<[f64; 3]>", "Option<[f64; 3]>"),
    ];
    let constants = constants
        .iter()
        .filter_map(|(value, of)| result(hole, value, of));
    let triples = hole.parameters.iter().filter_map(|(name, of)| {
        let is_triple = meaning(of) == Meaning::Triple;
        is_triple.then(|| result(hole, &format!("triple({name})"), "[f64; 3]"))?
    });
    constants.chain(triples).collect()
}

/// `call`, which returns the type `of`, in the form that the hole returns; `None` if it has none.
fn result(hole: &Hole, call: &str, of: &str) -> Option<String> {
    let sample = |wi: &str| {
        let f = match hole
            .parameters
            .iter()
            .any(|(name, _)| name == "reflectance")
        {
            true => "reflectance",
            false => "Spectrum::WHITE",
        };
        format!("kit::BsdfSample {{ wi: {wi}, f: {f}, pdf: 1.0, delta: true }}")
    };
    let (wanted, given) = (plain(&hole.returns), plain(of));
    let triple = |given: &str| meaning(given) == Meaning::Triple;
    let inner = given
        .strip_prefix("Option<")
        .and_then(|rest| rest.strip_suffix('>'));
    if given.starts_with("(Right,") {
        return Some(format!(
            "match ({call}).0 {{ {} }}",
            match wanted.as_str() {
                "f64" => "Right::Share(share) => share, _ => 0.0",
                "Vec3" => "Right::Direction(Some(d)) => Vec3::from(triple(d)), _ => Vec3::ZERO",
                "Option<Vec3>" =>
                    "Right::Direction(d) => d.map(|d| Vec3::from(triple(d))), _ => None",
                "Option<BsdfSample>" => "Right::Sample(sample) => Same::same(sample), _ => None",
                _ => return None,
            }
        ));
    }
    let text = match wanted.as_str() {
        "bool" if given == "bool" && hole.name == "has_surely_converged" => {
            format!("{call} && rule(samples, tolerance)")
        }
        "Ray" if triple(&given) => format!(
            "kit::Ray {{ o: camera.pos, d: Vec3::from(triple({call})), min_t: camera.n_clip, max_t: camera.f_clip }}"
        ),
        "Vec3" if triple(&given) => format!("Vec3::from(triple({call}))"),
        "Vec3" if inner.is_some_and(triple) => {
            format!("Vec3::from(triple({call}.unwrap_or_default()))")
        }
        "Spectrum" if triple(&given) => format!("Spectrum::from(triple({call}))"),
        "Spectrum" if given == "(Xyz,f64)" => format!("Spectrum::from(({call}).0)"),
        "f64" if given == "(Xyz,f64)" => format!("({call}).1"),
        "f64" if given == "(f64,Xyz)" => format!("({call}).0"),
        "Option<Vec3>" if triple(&given) => format!("Some(Vec3::from(triple({call})))"),
        "Option<Vec3>" if inner.is_some_and(triple) => {
            format!("{call}.map(|v| Vec3::from(triple(v)))")
        }
        "Option<Spectrum>" if triple(&given) => format!("Some(Spectrum::from(triple({call})))"),
        "Option<Spectrum>" if inner.is_some_and(triple) => {
            format!("{call}.map(|v| Spectrum::from(triple(v)))")
        }
        "Option<Spectrum>" if given == "(f64,Xyz)" => {
            format!("{{ let (chance, v) = {call}; (u < chance).then(|| Spectrum::from(v)) }}")
        }
        "Option<BsdfSample>" if triple(&given) => {
            format!("Some({})", sample(&format!("Vec3::from(triple({call}))")))
        }
        "Option<BsdfSample>" if inner.is_some_and(triple) => {
            format!("{call}.map(|wi| {})", sample("Vec3::from(triple(wi))"))
        }
        "Option<Interval>" if given == "Option<[f64;2]>" => {
            format!("{call}.map(|[min, max]| kit::Interval {{ min, max }})")
        }
        _ if wanted == given => format!("Same::same({call})"),
        _ => return None,
    };
    Some(text)
}

/// A type with the path of `kit` before its names: a pasted type may have the same name.
pub(super) fn qualified(of: &str) -> String {
    let mut text = String::new();
    let mut word = String::new();
    for c in of.chars().chain([' ']) {
        if c.is_alphanumeric() || c == '_' {
            word.push(c);
            continue;
        }
        let is_of_kit = word.starts_with(char::is_uppercase)
            && !["Option", "FnMut", "Fn", "W"].contains(&word.as_str());
        if is_of_kit {
            text.push_str("kit::");
        }
        text.push_str(&std::mem::take(&mut word));
        text.push(c);
    }
    text
}

/// What a pasted function finds around it.
pub(super) const PRELUDE: &str = "
    use kit::*;
    use kit::camera::*;
    use kit::warp::*;
    use std::collections::*;
    use std::f64::consts::*;

    pub trait Triple { fn triple(self) -> [f64; 3]; }
    impl Triple for Vec3 { fn triple(self) -> [f64; 3] { self.to_array() } }
    impl Triple for Spectrum { fn triple(self) -> [f64; 3] { self.to_array() } }
    impl Triple for [f64; 3] { fn triple(self) -> [f64; 3] { self } }
    fn triple(t: impl Triple) -> [f64; 3] { t.triple() }
    pub trait Pair { fn pair(self) -> [f64; 2]; }
    impl Pair for Vec2 { fn pair(self) -> [f64; 2] { self.to_array() } }
    impl Pair for [f64; 2] { fn pair(self) -> [f64; 2] { self } }
    fn pair(t: impl Pair) -> [f64; 2] { t.pair() }
    pub trait Same<T> { fn same(self) -> T; }
    impl<T> Same<T> for T { fn same(self) -> T { self } }
    impl<T: Clone> Same<T> for &T { fn same(self) -> T { self.clone() } }
    mod packed_truth {
        pub fn record<I: ?Sized, O>(_: &str, _: &str, _: &I, result: O) -> O { result }
        pub fn find<I: ?Sized, O>(task: &str, _: &str, _: &I) -> O { panic!(\"no table\") }
    }
";

/// What is needed beside [`PRELUDE`] if the pasted text defines a type of the grader.
pub(super) fn conversions(pasted: &str) -> String {
    let mut text = String::new();
    if pasted.contains("pub struct Camera {") && pasted.contains("c2w: [Xyz; 3]") {
        text.push_str(
            "impl Same<Camera> for &kit::Camera { fn same(self) -> Camera { Camera {
                pos: self.pos.to_array(),
                c2w: [self.c2w.x_axis, self.c2w.y_axis, self.c2w.z_axis].map(|v| v.to_array()),
                h_fov: self.h_fov, v_fov: self.v_fov, n_clip: self.n_clip, f_clip: self.f_clip,
            } } }\n",
        );
    }
    if pasted.contains("pub struct BsdfSample {") {
        text.push_str(
            "impl Same<Option<kit::BsdfSample>> for Option<BsdfSample> { fn same(self) -> Option<kit::BsdfSample> {
                self.map(|s| kit::BsdfSample { wi: s.wi.into(), f: s.f.into(), pdf: s.pdf, delta: s.delta })
            } }\n",
        );
    }
    text
}
