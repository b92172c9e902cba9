//! The arguments of a call.

use wire::global::SpecularCall;
use wire::work::Xyz;

/// An argument's value.
#[derive(Clone, Copy)]
pub(super) enum Argument {
    Number(f64),
    /// A unit vector, in local space.
    Direction(Xyz),
    Colour(Xyz),
}

/// The arguments of the function, by name, in its order.
pub(super) fn arguments(call: &SpecularCall) -> Vec<(&'static str, Argument)> {
    use Argument::{Colour, Direction, Number};
    match *call {
        SpecularCall::Fresnel { cos_i, eta } => {
            vec![("cos_i", Number(cos_i)), ("eta", Number(eta))]
        }
        SpecularCall::Reflect { wo } => vec![("wo", Direction(wo))],
        SpecularCall::Refract { wo, ior } => vec![("wo", Direction(wo)), ("ior", Number(ior))],
        SpecularCall::Mirror { reflectance, wo } => {
            vec![("reflectance", Colour(reflectance)), ("wo", Direction(wo))]
        }
        SpecularCall::Refraction {
            transmittance,
            ior,
            wo,
        } => vec![
            ("transmittance", Colour(transmittance)),
            ("ior", Number(ior)),
            ("wo", Direction(wo)),
        ],
        SpecularCall::Glass {
            reflectance,
            transmittance,
            ior,
            wo,
            choice,
        } => vec![
            ("reflectance", Colour(reflectance)),
            ("transmittance", Colour(transmittance)),
            ("ior", Number(ior)),
            ("wo", Direction(wo)),
            ("choice", Number(choice)),
        ],
    }
}
