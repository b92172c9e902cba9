import mujoco
import numpy as np
from common import lengths, run, unit


def build(vertices, faces):
    spec = mujoco.MjSpec()
    mesh = spec.add_mesh(name="m", uservert=vertices.ravel().tolist(), userface=faces.ravel().tolist())
    mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="m")
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def trace(scene, rays):
    model, data = scene
    geom = np.zeros(1, np.int32)
    t = [mujoco.mj_ray(model, data, ray[:3], d, None, 1, -1, geom) for ray, d in zip(rays, unit(rays))]
    t = np.array(t)
    return {"t": np.where(t < 0.0, np.inf, t) / lengths(rays)}


run("mujoco", "mujoco", mujoco.__version__, "mj_ray on a mesh geom", "f64", build, trace, most=5000,
    columns=lambda column: column not in ("at_start", "at_end"))
