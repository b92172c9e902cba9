// Reads cases, runs a library on them and writes its answers. An adapter calls `run` once for each row.
#pragma once
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

struct Mesh {
    std::vector<float> vertices;  // three each
    std::vector<uint32_t> faces;  // three each
};
using Ray = const double*;  // origin, direction, min_t, max_t

inline double thread_seconds() {
    timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
}

// `build(mesh)` returns a scene; `trace(scene, ray, hit)` fills t (INFINITY for a miss), triangle and number of hits.
template <class Build, class Trace>
void run(char** arguments, const std::string& row, const std::string& about, Build build, Trace trace) {
    namespace fs = std::filesystem;
    const fs::path out = fs::path(arguments[2]) / row;
    fs::create_directories(out);
    std::ofstream(out / "about.tsv") << about;
    const char* only = std::getenv("RAY_COLUMNS");
    for (const auto& entry : fs::directory_iterator(arguments[1])) {
        const std::string column = entry.path().stem();
        if (entry.path().extension() != ".case" || (only && column != only)) continue;
        std::ifstream file(entry.path(), std::ios::binary);
        std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
        uint32_t counts[3];
        std::memcpy(counts, &bytes[8], 12);
        const auto [n, m, k] = counts;
        std::vector<double> vertices(3 * n), rays(8 * k);
        Mesh mesh{{}, std::vector<uint32_t>(3 * m)};
        std::memcpy(vertices.data(), &bytes[20], 24 * n);
        std::memcpy(mesh.faces.data(), &bytes[20 + 24 * n], 12 * m);
        std::memcpy(rays.data(), &bytes[20 + 24 * n + 12 * m], 64 * k);
        mesh.vertices.assign(vertices.begin(), vertices.end());
        auto scene = build(mesh);
        std::vector<double> hits(3 * k);
        const double before = thread_seconds();
        for (uint32_t i = 0; i < k; i++) trace(scene, &rays[8 * i], &hits[3 * i]);
        const double seconds = thread_seconds() - before;
        std::ofstream answer(out / (column + ".answer"), std::ios::binary);
        answer.write("FLHITS01", 8).write((const char*)&k, 4).write((const char*)&seconds, 8);
        answer.write((const char*)hits.data(), 24 * k);
    }
}
