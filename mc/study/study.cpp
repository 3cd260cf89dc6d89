#include "mc/study/study.hpp"

#include <algorithm>

namespace gearpod::mc {

const RandomInput* Study::find_random(const std::string& key) const {
    const auto found = std::find_if(random.begin(), random.end(),
                                    [&](const RandomInput& input) { return input.key == key; });
    return found == random.end() ? nullptr : &*found;
}

}  // namespace gearpod::mc
