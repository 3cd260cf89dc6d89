#include "mc/forecast/peak_memory.hpp"

#include <fstream>
#include <string>

namespace gearpod::mc {

double peak_memory_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        if (double kilobytes = 0.0; word == "VmHWM:" && status >> kilobytes) {
            return 1024.0 * kilobytes;
        }
    }
    return 0.0;
}

}  // namespace gearpod::mc
