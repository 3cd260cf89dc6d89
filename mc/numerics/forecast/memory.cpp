#include "mc/numerics/forecast/memory.hpp"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

namespace gearpod::mc {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

// Entry such as "MemAvailable:   123 kB", in bytes. `unit`: bytes, of its number.
double entry_of(const std::filesystem::path& path, const std::string& name, double otherwise,
                double unit = 1024.0) {
    std::ifstream stream(path);
    for (std::string word; stream >> word;) {
        if (double number = 0.0; word == name && stream >> number) {
            return unit * number;
        }
    }
    return otherwise;
}

// Number in a file. "max" or a missing file means no limit.
double number_in(const std::filesystem::path& path) {
    std::ifstream stream(path);
    double number = 0.0;
    return stream >> number ? number : kUnlimited;
}

double left_of_limits() {
    double left = kUnlimited;
    for (const auto& [resource, used] :
         {std::pair{RLIMIT_AS, "VmSize:"}, {RLIMIT_DATA, "VmData:"}}) {
        rlimit limit{};
        if (::getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
            left = std::min(left, static_cast<double>(limit.rlim_cur) -
                                      entry_of("/proc/self/status", used, 0.0));
        }
    }
    return left;
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

double left_in_control_groups(std::istream& groups, const std::filesystem::path& mounted) {
    double left = kUnlimited;
    for (std::string line; std::getline(groups, line);) {  // for example "0::/system.slice/job"
        const auto first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) {
            continue;
        }
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const bool version_1 = ("," + controllers + ",").find(",memory,") != std::string::npos;
        if (!controllers.empty() && !version_1) {
            continue;
        }
        // The kernel frees cached files before it refuses memory.
        const auto [most, used, cached] =
            version_1 ? std::tuple{"memory.limit_in_bytes", "memory.usage_in_bytes",
                                   "total_inactive_file"}
                      : std::tuple{"memory.max", "memory.current", "inactive_file"};
        const auto top = version_1 ? mounted / "memory" : mounted;
        const std::filesystem::path path(line.substr(second + 1));
        // Every group above limits it too. In a container, only the top may be visible.
        for (auto group = path.relative_path();; group = group.parent_path()) {
            if (const double limit = number_in(top / group / most); limit < kUnlimited) {
                left = std::min(left, limit - number_in(top / group / used) +
                                          entry_of(top / group / "memory.stat", cached, 0.0, 1.0));
            }
            if (group.empty()) {
                break;
            }
        }
    }
    return left;
}

double available_memory_bytes() {
    std::ifstream groups("/proc/self/cgroup");
    return std::max(0.0,
                    std::min({entry_of("/proc/meminfo", "MemAvailable:", kUnlimited),
                              left_in_control_groups(groups, "/sys/fs/cgroup"), left_of_limits()}));
}

}  // namespace gearpod::mc
