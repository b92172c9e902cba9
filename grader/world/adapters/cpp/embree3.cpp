// Embree 3 through rtcIntersect1, in its default mode and with the flag "robust".
#include <embree3/rtcore.h>
#include <cmath>
#include "common.hpp"

int main(int, char** arguments) {
    RTCDevice device = rtcNewDevice("threads=1");
    for (bool robust : {false, true}) {
        auto build = [&](const Mesh& mesh) {
            RTCScene scene = rtcNewScene(device);
            if (robust) rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
            rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
            RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
            auto copy = [&](RTCBufferType type, RTCFormat format, auto& list) {
                void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, 12, list.size() / 3);
                std::memcpy(buffer, list.data(), 4 * list.size());
            };
            copy(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices);
            copy(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.faces);
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene, geometry);
            rtcCommitScene(scene);
            return scene;
        };
        auto trace = [](RTCScene scene, Ray ray, double* hit) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            RTCRayHit query{};
            query.ray = {float(ray[0]), float(ray[1]), float(ray[2]), float(ray[6]), float(ray[3]), float(ray[4]),
                         float(ray[5]), 0.0f, float(ray[7]), ~0u, 0, 0};
            query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene, &context, &query);
            const bool found = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
            hit[0] = found ? query.ray.tfar : INFINITY;
            hit[1] = found ? query.hit.primID : -1.0;
            hit[2] = NAN;
        };
        const std::string mode = robust ? "robust" : "default";
        run(arguments, "embree3_" + mode,
            "library\tEmbree\nversion\t" RTC_VERSION_STRING "\ninterface\trtcIntersect1, high quality, " + mode + "\nprecision\tf32\n",
            build, trace);
    }
}
