#include "mc/files/signal_file.hpp"

#include <algorithm>

namespace gearpod::mc {

bool SignalFile::has(const std::string& name) const {
    const auto all = names();
    return std::find(all.begin(), all.end(), name) != all.end();
}

}  // namespace gearpod::mc
