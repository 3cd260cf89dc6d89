// The memory of this process.
#pragma once

namespace gearpod::mc {

// The most that it has had in memory at a time, bytes (VmHWM of /proc/self/status); 0 where that is
// not told.
double peak_memory_bytes();

}  // namespace gearpod::mc
