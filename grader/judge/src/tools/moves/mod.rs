//! Exact symmetries of questions. An instructor's run asks moved questions, and moves the answers
//! back.
//!
//! Students have the questions of seed 0, so code could contain the answers to them. With another
//! seed each question is moved: its axes permuted or turned round, its lengths or its light
//! multiplied by a power of two, its primitives in another order. Nothing rounds in another way, so
//! the answer of correct code, moved back, has the same bits, and the same judge judges it. An
//! answer that was learned by heart is wrong.
//!
//! A kind of work says which symmetries its questions have ([`Symmetries`]), and moves a question
//! by a [`Move`] and an answer by its inverse. The seed also draws the order of the cases of a task
//! and of the calls of a case. The worker makes the calls in this order (`harness::each_call`), so
//! nothing is to be moved back.

mod axes;
mod symmetries;

pub(crate) use axes::{Axes, AxisMoves};
pub(crate) use symmetries::{LightMoves, Symmetries, most_if_ordinary, ray_numbers, shuffled};

use wire::answer::{Hit, HitsAnswer};
use wire::work::{Node, Probe, Ray, Xyz};

/// A move of a question, or back.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Move {
    axes: Axes,
    length: f64,
    speed: f64,
    light: Xyz,
    channels: [usize; 3],
    order: Vec<u32>,
}

impl Move {
    /// The move that changes nothing.
    pub(crate) const IDENTITY: Move = Move {
        axes: Axes::SAME,
        length: 1.0,
        speed: 1.0,
        light: [1.0; 3],
        channels: [0, 1, 2],
        order: Vec::new(),
    };

    /// Whether it changes nothing.
    pub(crate) fn is_identity(&self) -> bool {
        *self == Move::IDENTITY
    }

    /// The move back.
    pub(crate) fn inverse(&self) -> Move {
        let mut channels = [0; 3];
        let mut order = vec![0; self.order.len()];
        for (to, &from) in self.channels.iter().enumerate() {
            channels[from] = to;
        }
        for (to, &from) in (0..).zip(&self.order) {
            order[from as usize] = to;
        }
        Move {
            axes: self.axes.inverse(),
            length: 1.0 / self.length,
            speed: 1.0 / self.speed,
            light: self.light.map(|factor| 1.0 / factor),
            channels,
            order,
        }
    }

    /// The move of the axes.
    pub(crate) fn axes(&self) -> Axes {
        self.axes
    }

    /// A point.
    pub(crate) fn point(&self, p: Xyz) -> Xyz {
        self.axes.of(p).map(|x| self.length * x)
    }

    /// The direction of a ray.
    pub(crate) fn direction(&self, d: Xyz) -> Xyz {
        self.axes.of(d).map(|x| self.speed * x)
    }

    /// A direction that keeps its length, such as a normal.
    pub(crate) fn unit(&self, n: Xyz) -> Xyz {
        self.axes.of(n)
    }

    /// A length, such as a radius.
    pub(crate) fn length(&self, x: f64) -> f64 {
        self.length * x
    }

    /// A place on a ray: a length in units of that of the direction.
    pub(crate) fn t(&self, t: f64) -> f64 {
        self.length / self.speed * t
    }

    /// A ray.
    pub(crate) fn ray(&self, ray: &Ray) -> Ray {
        Ray {
            o: self.point(ray.o),
            d: self.direction(ray.d),
            min_t: self.t(ray.min_t),
            max_t: self.t(ray.max_t),
        }
    }

    /// A ray and the number of its shape.
    pub(crate) fn probe(&self, probe: &Probe) -> Probe {
        Probe {
            shape: probe.shape,
            ray: self.ray(&probe.ray),
        }
    }

    /// The vertices of a triangle and their normals.
    pub(crate) fn triangle(&self, [p0, p1, p2, n0, n1, n2]: &[Xyz; 6]) -> [Xyz; 6] {
        let [p0, p1, p2] = [p0, p1, p2].map(|p| self.point(*p));
        let [n0, n1, n2] = [n0, n1, n2].map(|n| self.unit(*n));
        [p0, p1, p2, n0, n1, n2]
    }

    /// The centre and the radius of a sphere.
    pub(crate) fn sphere(&self, (center, radius): &(Xyz, f64)) -> (Xyz, f64) {
        (self.point(*center), self.length(*radius))
    }

    /// The nodes of a tree.
    pub(crate) fn nodes(&self, nodes: &[Node]) -> Vec<Node> {
        let moved = nodes.iter().map(|node| Node {
            bounds: self.corners(node.bounds),
            kind: node.kind,
        });
        moved.collect()
    }

    /// The corners of a box. Only for moves that turn no axis round.
    pub(crate) fn corners(&self, corners: [Xyz; 2]) -> [Xyz; 2] {
        corners.map(|corner| self.point(corner))
    }

    /// A record of a hit.
    pub(crate) fn hit(&self, hit: &Hit) -> Hit {
        Hit {
            t: self.t(hit.t),
            p: self.point(hit.p),
            n: self.unit(hit.n),
            ng: self.unit(hit.ng),
            ..*hit
        }
    }

    /// The hits of many rays.
    pub(crate) fn hits(&self, answer: &HitsAnswer) -> HitsAnswer {
        let hits = answer.hits.iter();
        HitsAnswer {
            hits: hits.map(|hit| hit.map(|hit| self.hit(&hit))).collect(),
            max_t: answer.max_t.iter().map(|t| self.t(*t)).collect(),
            ..*answer
        }
    }

    /// Radiance, or another colour that light is proportional to.
    pub(crate) fn light(&self, colour: Xyz) -> Xyz {
        [0, 1, 2].map(|channel| self.light[channel] * colour[channel])
    }

    /// Luminance, where all channels have the same factor.
    pub(crate) fn luminance(&self, luminance: f64) -> f64 {
        self.light[0] * luminance
    }

    /// The square of a luminance.
    pub(crate) fn squared_luminance(&self, squared: f64) -> f64 {
        self.light[0] * self.light[0] * squared
    }

    /// A colour with permuted channels.
    pub(crate) fn permuted(&self, colour: Xyz) -> Xyz {
        self.channels.map(|channel| colour[channel])
    }

    /// Of each primitive, or one for each, in the new order.
    pub(crate) fn reordered<T: Clone>(&self, of_each: &[T]) -> Vec<T> {
        match self.order.len() == of_each.len() {
            true => {
                let order = self.order.iter();
                order.map(|&from| of_each[from as usize].clone()).collect()
            }
            false => of_each.to_vec(),
        }
    }

    /// For each primitive its new number.
    pub(crate) fn numbers(&self) -> Vec<u32> {
        self.inverse().order
    }
}
