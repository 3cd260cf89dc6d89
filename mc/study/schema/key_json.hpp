// JSON of a study key, from which editors and the documentation take its description.
#pragma once

#include <nlohmann/json.hpp>

#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {

// Section, name, unit, type, default, condition, range and meaning of a key.
nlohmann::ordered_json key_json(const Key& key);

}  // namespace gearpod::mc
