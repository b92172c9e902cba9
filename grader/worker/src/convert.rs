//! Converts between the plain numbers of `wire` and the types of `kit`.

#[cfg(any(feature = "intersect", feature = "bbox", feature = "bvh"))]
use wire::work::Xyz;

#[cfg(any(
    feature = "intersect",
    feature = "bbox",
    feature = "bvh",
    feature = "global"
))]
pub(crate) fn ray(r: &wire::work::Ray) -> kit::Ray {
    kit::Ray {
        o: kit::Vec3::from(r.o),
        d: kit::Vec3::from(r.d),
        min_t: r.min_t,
        max_t: r.max_t,
    }
}

#[cfg(any(
    feature = "raygen",
    feature = "intersect",
    feature = "bvh",
    feature = "direct",
    feature = "global"
))]
pub(crate) fn wire_ray(r: &kit::Ray) -> wire::work::Ray {
    wire::work::Ray {
        o: r.o.into(),
        d: r.d.into(),
        min_t: r.min_t,
        max_t: r.max_t,
    }
}

#[cfg(feature = "intersect")]
pub(crate) fn wire_hit(h: &kit::Hit) -> wire::answer::Hit {
    wire::answer::Hit {
        t: h.t,
        p: h.p.into(),
        n: h.n.into(),
        ng: h.ng.into(),
        uv: h.uv.into(),
        prim: h.prim.0,
    }
}

#[cfg(feature = "intersect")]
pub(crate) fn triangle(v: &[Xyz; 6]) -> kit::Triangle {
    let [p0, p1, p2, n0, n1, n2] = v.map(kit::Vec3::from);
    kit::Triangle {
        p0,
        p1,
        p2,
        n0,
        n1,
        n2,
    }
}

#[cfg(feature = "intersect")]
pub(crate) fn sphere(&(center, radius): &(Xyz, f64)) -> kit::Sphere {
    kit::Sphere {
        center: kit::Vec3::from(center),
        radius,
    }
}

#[cfg(any(feature = "bbox", feature = "bvh"))]
pub(crate) fn aabb([min, max]: &[Xyz; 2]) -> kit::Aabb {
    kit::Aabb {
        min: kit::Vec3::from(*min),
        max: kit::Vec3::from(*max),
    }
}

#[cfg(feature = "bvh")]
pub(crate) fn wire_aabb(b: &kit::Aabb) -> [Xyz; 2] {
    [b.min.into(), b.max.into()]
}

#[cfg(any(feature = "direct", feature = "global"))]
pub(crate) fn wire_sample(s: &kit::BsdfSample) -> wire::light::BsdfSample {
    wire::light::BsdfSample {
        wi: s.wi.into(),
        f: s.f.to_array(),
        pdf: s.pdf,
        delta: s.delta,
    }
}
