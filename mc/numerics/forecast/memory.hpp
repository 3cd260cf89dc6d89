// Memory of this process and of this machine.
#pragma once

#include <filesystem>
#include <istream>

namespace gearpod::mc {

// Peak memory of this process so far; 0 if the system does not report it.
double peak_memory_bytes();

// Memory that this process holds now; 0 if the system does not report it.
double resident_memory_bytes();

// Fixes the sizes from which freed memory returns to the system. By default the C library adapts
// them to what was freed first, so that the peak memory changes from run to run and most large
// buffers of a tile are mapped anew. Call once, before other threads start.
void fix_memory_limits();

// Memory in bytes that the control groups of a process allow it beyond what they use; infinite
// without a limit. `groups` is its /proc/PID/cgroup (versions 1 and 2), `mounted` is
// /sys/fs/cgroup. The limits of all groups above apply too.
double left_in_control_groups(std::istream& groups, const std::filesystem::path& mounted);

// Memory that this process may still allocate: the minimum for the machine, its control groups and
// its own limit.
double available_memory_bytes();

}  // namespace gearpod::mc
