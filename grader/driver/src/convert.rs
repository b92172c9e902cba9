//! Converts between the plain numbers of `wire` and the types of `kit`.

use wire::work::Xyz;

pub(crate) fn ray(r: &wire::work::Ray) -> kit::Ray {
    kit::Ray {
        o: kit::Vec3::from(r.o),
        d: kit::Vec3::from(r.d),
        min_t: r.min_t,
        max_t: r.max_t,
    }
}

pub(crate) fn wire_ray(r: &kit::Ray) -> wire::work::Ray {
    wire::work::Ray {
        o: r.o.into(),
        d: r.d.into(),
        min_t: r.min_t,
        max_t: r.max_t,
    }
}

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

pub(crate) fn triangle(v: &[Xyz; 6]) -> kit::Triangle {
    let [p0, p1, p2, n0, n1, n2] = v.map(kit::Vec3::from);
    kit::Triangle::smooth([p0, p1, p2], [n0, n1, n2])
}

pub(crate) fn sphere(&(center, radius): &(Xyz, f64)) -> kit::Sphere {
    kit::Sphere {
        center: kit::Vec3::from(center),
        radius,
    }
}

pub(crate) fn aabb([min, max]: &[Xyz; 2]) -> kit::Aabb {
    kit::Aabb {
        min: kit::Vec3::from(*min),
        max: kit::Vec3::from(*max),
    }
}

pub(crate) fn wire_aabb(b: &kit::Aabb) -> [Xyz; 2] {
    [b.min.into(), b.max.into()]
}

pub(crate) fn wire_sample(s: &kit::BsdfSample) -> wire::light::BsdfSample {
    wire::light::BsdfSample {
        wi: s.wi.into(),
        f: s.f.to_array(),
        pdf: s.pdf,
        delta: s.delta,
    }
}
