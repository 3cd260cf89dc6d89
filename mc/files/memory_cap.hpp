// A limit on the memory that a library may take for a file, whatever the file says it needs.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <fstream>

namespace gearpod::mc {

// While it lives, the process gets at most so many more bytes; allocations beyond fail. Lowers a
// limit that there is and never raises it. For libraries that bear a failed allocation, while no
// other thread allocates much.
class MemoryCap {
  public:
    explicit MemoryCap(std::size_t more) {
        std::ifstream statm("/proc/self/statm");
        std::size_t pages = 0;
        known_ = statm >> pages && ::getrlimit(RLIMIT_AS, &before_) == 0;
        const rlim_t most = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + more;
        if (known_ && most < before_.rlim_cur) {
            const rlimit capped{most, before_.rlim_max};
            ::setrlimit(RLIMIT_AS, &capped);
        }
    }
    MemoryCap(const MemoryCap&) = delete;
    MemoryCap& operator=(const MemoryCap&) = delete;
    ~MemoryCap() {
        if (known_) {
            ::setrlimit(RLIMIT_AS, &before_);
        }
    }

  private:
    rlimit before_{};
    bool known_ = false;
};

}  // namespace gearpod::mc
