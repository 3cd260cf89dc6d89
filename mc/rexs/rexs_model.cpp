#include "mc/rexs/rexs_model.hpp"

#include <algorithm>

namespace gearpod::mc {

const RexsAttribute* RexsComponent::find(std::string_view attribute) const {
    const auto at = std::ranges::find_if(attributes, [&](const RexsAttribute& candidate) {
        return candidate.id == attribute && !candidate.text.empty();
    });
    return at == attributes.end() ? nullptr : &*at;
}

std::string RexsRelation::part(std::string_view role) const {
    const auto at =
        std::ranges::find_if(parts, [&](const auto& part) { return part.first == role; });
    return at == parts.end() ? "" : at->second;
}

const RexsComponent* RexsModel::component(std::string_view id) const {
    const auto at = index.find(id);
    return at == index.end() ? nullptr : &components[at->second];
}

std::vector<const RexsComponent*> RexsModel::related(std::string_view relation,
                                                     std::string_view from, std::string_view id,
                                                     std::string_view to) const {
    std::vector<const RexsComponent*> found;
    for (const RexsRelation& candidate : relations) {
        if (candidate.type != relation || candidate.part(from) != id) {
            continue;
        }
        const RexsComponent* part = component(candidate.part(to));
        if (part != nullptr && std::ranges::find(found, part) == found.end()) {
            found.push_back(part);
        }
    }
    return found;
}

void RexsModel::apply(const RexsLoadCase& load_case) {
    for (const RexsComponent& loaded : load_case.components) {
        const auto at = index.find(loaded.id);
        if (at == index.end()) {
            continue;
        }
        std::vector<RexsAttribute>& attributes = components[at->second].attributes;
        for (const RexsAttribute& attribute : loaded.attributes) {
            std::erase_if(attributes, [&](const RexsAttribute& replaced) {
                return replaced.id == attribute.id;
            });
            attributes.push_back(attribute);
        }
    }
}

}  // namespace gearpod::mc
