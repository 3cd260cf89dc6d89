// Gear-unit model in REXS (Reusable Engineering EXchange Standard, www.rexs.info), versions 1.0 to
// 1.6: components with attributes, and relations between components.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mc/files/input/problems.hpp"

namespace gearpod::mc {

struct RexsAttribute {
    std::string id, unit, text;  // text: without surrounding blanks; of an array its first value
    bool scalar = true;          // false: an array or a matrix
    int line = 0;
};

struct RexsComponent {
    std::string id, type, name;
    std::vector<RexsAttribute> attributes;
    int line = 0;

    // Attribute of that name, or null. Empty attributes count as missing.
    const RexsAttribute* find(std::string_view attribute) const;
    // Type and id for messages: "cylindrical_gear 23".
    std::string label() const { return type + " " + id; }
};

struct RexsRelation {
    std::string type;
    std::vector<std::pair<std::string, std::string>> parts;  // role and component id
    int line = 0;

    // Component id with that role; empty if there is none.
    std::string part(std::string_view role) const;
};

// Attributes of components under one load.
struct RexsLoadCase {
    std::string id;
    std::vector<RexsComponent> components;
};

struct RexsModel {
    std::string file, version;
    std::vector<RexsComponent> components;
    std::vector<RexsRelation> relations;
    std::vector<RexsLoadCase> load_cases;
    Problems notices;  // statements about the file that do not prevent its use
    std::map<std::string, std::size_t, std::less<>> index;  // of the components, by id

    // Component with that id, or null.
    const RexsComponent* component(std::string_view id) const;
    // Components with role `to` in relations of that type in which the component `id` has role
    // `from`, in the order of the file.
    std::vector<const RexsComponent*> related(std::string_view relation, std::string_view from,
                                              std::string_view id, std::string_view to) const;
    // Replaces attributes of the components by those of a load case.
    void apply(const RexsLoadCase& load_case);
};

// Reads a REXS file. The result is empty if there are problems. Refuses files that are not regular,
// too large or too deeply nested, document type declarations (they define entities), archives, JSON
// and other versions.
RexsModel read_rexs(const std::string& path, Problems& problems);
// The same for text in memory; `name` stands for the file in messages.
RexsModel parse_rexs(std::string text, const std::string& name, Problems& problems);

}  // namespace gearpod::mc
