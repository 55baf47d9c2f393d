// SURF as dlib does it: the independent implementation that ours is measured against.
// Build: make -C tests/oracle (needs g++ and libdlib-dev)
//
//   dlib_surf points IMAGE.pgm COUNT THRESHOLD           x y scale angle score laplacian, strongest first
//   dlib_surf match A.pgm B.pgm COUNT THRESHOLD          index in A, index in B, distance
//   dlib_surf time IMAGE.pgm COUNT THRESHOLD REPEATS     minimum and median ms, detection and description
//
// Images are 8-bit binary PGM. Pixel centres lie at whole numbers; scale is SURF's s (1.2 for the 9×9 filter);
// the angle is in radians.

#include <dlib/array2d.h>
#include <dlib/image_keypoint.h>
#include <dlib/revision.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

using Image = dlib::array2d<unsigned char>;
using Points = std::vector<dlib::surf_point>;

/// Ratio of the best to the second-best distance above which a match is ambiguous.
constexpr double RATIO = 0.8;

Image read_pgm(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string magic;
    long width = 0, height = 0, peak = 0;
    file >> magic >> width >> height >> peak;
    file.get();
    if (!file || magic != "P5" || peak != 255 || width < 1 || height < 1)
        throw std::runtime_error(path + ": not an 8-bit binary PGM");
    Image image(height, width);
    for (long row = 0; row < height; ++row)
        file.read(reinterpret_cast<char*>(&image[row][0]), width);
    if (!file) throw std::runtime_error(path + ": cut short");
    return image;
}

/// How many points dlib must be asked for to return `count`: it drops those near the border only after the cut.
long points_to_ask_for(const Image& image, long count, double threshold) {
    const long limit = 100000;
    for (long ask = count; ask < limit;) {
        const long found = dlib::get_surf_points(image, ask, threshold).size();
        if (found >= count) return ask;
        ask += count - found;
    }
    return limit;
}

/// The `count` strongest points.
Points strongest(const Image& image, long count, double threshold) {
    Points points = dlib::get_surf_points(image, points_to_ask_for(image, count, threshold), threshold);
    if (static_cast<long>(points.size()) > count) points.resize(count);
    return points;
}

/// The nearest and the second-nearest descriptor among points whose Laplacian has the same sign.
struct Neighbour {
    long index = -1;
    double distance = std::numeric_limits<double>::infinity();
    double second = std::numeric_limits<double>::infinity();
};

Neighbour nearest(const dlib::surf_point& point, const Points& others) {
    Neighbour best;
    for (long i = 0; i < static_cast<long>(others.size()); ++i) {
        if ((others[i].p.laplacian > 0) != (point.p.laplacian > 0)) continue;
        const double distance = dlib::length(others[i].des - point.des);
        if (distance < best.distance) {
            best.second = best.distance;
            best.distance = distance;
            best.index = i;
        } else if (distance < best.second) {
            best.second = distance;
        }
    }
    return best;
}

void print_points(const Points& points) {
    for (const auto& point : points)
        std::printf("%.2f %.2f %.2f %.4f %.3f %+d\n", point.p.center.x(), point.p.center.y(), point.p.scale,
                    point.angle, point.p.score, point.p.laplacian > 0 ? 1 : -1);
}

/// Nearest neighbours that are unambiguous from A to B and mutual.
void print_matches(const Points& a, const Points& b) {
    for (long i = 0; i < static_cast<long>(a.size()); ++i) {
        const Neighbour there = nearest(a[i], b);
        if (there.index < 0 || there.distance >= RATIO * there.second) continue;
        if (nearest(b[there.index], a).index != i) continue;
        std::printf("%ld %ld %.4f\n", i, there.index, there.distance);
    }
}

void print_time(const Image& image, long count, double threshold, int repeats) {
    using Clock = std::chrono::steady_clock;
    const long ask = points_to_ask_for(image, count, threshold);
    size_t found = 0;
    std::vector<double> ms;
    for (int i = 0; i < repeats; ++i) {
        const auto start = Clock::now();
        found = dlib::get_surf_points(image, ask, threshold).size();
        ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    std::sort(ms.begin(), ms.end());
    std::printf("points %zu min_ms %.3f median_ms %.3f\n", found, ms.front(), ms[ms.size() / 2]);
}

int main(int argc, char** argv) try {
    const std::vector<std::string> args(argv + 1, argv + argc);
    const std::string command = args.empty() ? "" : args[0];
    if (command == "version") {
        std::printf("dlib %d.%d.%d\n", DLIB_MAJOR_VERSION, DLIB_MINOR_VERSION, DLIB_PATCH_VERSION);
    } else if (command == "points" && args.size() == 4) {
        print_points(strongest(read_pgm(args[1]), std::stol(args[2]), std::stod(args[3])));
    } else if (command == "match" && args.size() == 5) {
        const long count = std::stol(args[3]);
        const double threshold = std::stod(args[4]);
        print_matches(strongest(read_pgm(args[1]), count, threshold), strongest(read_pgm(args[2]), count, threshold));
    } else if (command == "time" && args.size() == 5) {
        print_time(read_pgm(args[1]), std::stol(args[2]), std::stod(args[3]), std::max(1, std::stoi(args[4])));
    } else {
        std::fprintf(stderr,
                     "usage: dlib_surf points IMAGE.pgm COUNT THRESHOLD\n"
                     "       dlib_surf match A.pgm B.pgm COUNT THRESHOLD\n"
                     "       dlib_surf time IMAGE.pgm COUNT THRESHOLD REPEATS\n"
                     "       dlib_surf version\n");
        return 2;
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "dlib_surf: %s\n", error.what());
    return 1;
}
