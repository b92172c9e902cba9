//! Each formula has the bits of the plain function that it restates, at every width and with every
//! instruction set, for hard inputs and random ones.

mod camera;
mod diffuse;
mod frame;
mod inputs;
mod light;
mod mis;
mod record;
mod roulette;
mod sin_cos;
mod specular;
mod sphere;
mod surface;
mod triangle;
mod widths;
