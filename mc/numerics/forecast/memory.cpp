#include "mc/numerics/forecast/memory.hpp"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace gearpod::mc {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

// Entry such as "MemAvailable:   123 kB", in bytes.
double entry_of(const char* path, const std::string& name, double otherwise) {
    std::ifstream stream(path);
    for (std::string word; stream >> word;) {
        if (double kilobytes = 0.0; word == name && stream >> kilobytes) {
            return 1024.0 * kilobytes;
        }
    }
    return otherwise;
}

// Number in a file. "max" or a missing file means no limit.
double number_in(const char* path) {
    std::ifstream stream(path);
    double number = 0.0;
    return stream >> number ? number : kUnlimited;
}

double left_in_group() {
    const double most = number_in("/sys/fs/cgroup/memory.max");
    return most < kUnlimited ? most - number_in("/sys/fs/cgroup/memory.current") : kUnlimited;
}

double left_of_limit() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
        return kUnlimited;
    }
    return static_cast<double>(limit.rlim_cur) - entry_of("/proc/self/status", "VmSize:", 0.0);
}

}  // namespace

double peak_memory_bytes() {
    return entry_of("/proc/self/status", "VmHWM:", 0.0);
}

double resident_memory_bytes() {
    return entry_of("/proc/self/status", "VmRSS:", 0.0);
}

void fix_memory_limits() {
#ifdef __GLIBC__
    // The largest values to which the C library adapts them.
    mallopt(M_MMAP_THRESHOLD, 32 << 20);
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

double available_memory_bytes() {
    return std::min(
        {entry_of("/proc/meminfo", "MemAvailable:", kUnlimited), left_in_group(), left_of_limit()});
}

}  // namespace gearpod::mc
