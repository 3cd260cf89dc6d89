#include "mc/study/reading/unknown_keys.hpp"

#include <fmt/format.h>

#include "mc/input/spelling.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

struct Guess {
    const Key* key = nullptr;  // what was probably meant
    std::string words;
};

Guess guess_by_unit(const std::string& section, const std::string& name) {
    for (const Key& key : schema()) {
        if (key.section != section || key.unit.suffix.empty()) {
            continue;
        }
        if (key.stem() == name) {
            return {&key, fmt::format("did you mean {}? (unit missing)", key.name)};
        }
        if (key.stem() == without_unit(name)) {
            return {&key,
                    fmt::format("did you mean {}? (its unit is {})", key.name, key.unit.name)};
        }
    }
    return {};
}

// A key whose name without its unit is near.
const Key* nearest_stem(const std::string& section, const std::string& name) {
    const Key* found = nullptr;
    int least = 0;
    for (const Key& key : schema()) {
        if (key.section != section || key.unit.suffix.empty()) {
            continue;
        }
        const std::string_view stem = key.stem();
        const int distance = edit_distance(name, stem);
        if (distance <= std::max(1, static_cast<int>(stem.size()) / 3) &&
            (found == nullptr || distance < least)) {
            found = &key;
            least = distance;
        }
    }
    return found;
}

Guess guess_key(const std::string& section, const std::string& name) {
    if (Guess guess = guess_by_unit(section, name); guess.key != nullptr) {
        return guess;
    }
    std::vector<std::string_view> names;
    for (const Key& key : schema()) {
        if (key.name == name) {
            return {nullptr, fmt::format("it belongs in [{}]", key.section)};
        }
        if (key.section == section) {
            names.push_back(key.name);
        }
    }
    const std::string words = suggest(name, names);
    if (words.starts_with("did you mean")) {
        return {find_key(section, nearest(name, names)), words};
    }
    if (const Key* key = nearest_stem(section, name)) {
        return {key, fmt::format("did you mean {}?", key->name)};
    }
    return {nullptr, words};
}

}  // namespace

void reject_unknown_key(StudyDraft& draft, const std::string& prefix, const std::string& section,
                        const Entry& entry) {
    const Guess guess = guess_key(section, entry.name);
    draft.reject(entry.position, prefix + section + "." + entry.name, "unknown key", guess.words);
    if (guess.key != nullptr) {
        draft.bad.insert(guess.key->path());
    }
}

}  // namespace gearpod::mc
