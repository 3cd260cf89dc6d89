// Keys and values of earlier versions of study files.
#pragma once

#include <string>
#include <string_view>

#include "mc/files/input/document.hpp"

namespace gearpod::mc {

// Present spelling of a path, "random." in front and parts of a distribution behind included;
// `path` itself if it is no former spelling: "gearbox.sun_teeth" gives "gearbox.sun.teeth".
std::string current_path(const std::string& path);

// Replaces former spellings in studies and options by the present ones, and collects notices.
class FormerKeys {
  public:
    // Renames the keys of a document. Removed keys are taken out: with a notice if their value has
    // no effect, else with a problem.
    void replace(Value& document, Problems& problems);
    // Renames the key of "section.key=value".
    std::string replace(const std::string& assignment);
    // Notices of everything replaced: one for all former spellings.
    Problems notices() const;

  private:
    void rename(Value& table, const std::string& prefix, Problems& problems);
    std::string renamed(const std::string& path, const Position& position);

    Problems ignored_;
    Problems renamed_;  // notices, one for each former spelling
};

// Value of a choice key in earlier versions and the present one, which replaces it or is proposed.
struct FormerValue {
    std::string_view key, former, current;
    bool removed;  // true: it is refused
};
// nullptr if the value is no former one.
const FormerValue* former_value(std::string_view key, std::string_view value);

}  // namespace gearpod::mc
