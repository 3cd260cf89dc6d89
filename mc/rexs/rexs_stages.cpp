#include "mc/rexs/rexs_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

namespace gearpod::mc {
namespace {

using Components = std::vector<const RexsComponent*>;

// Gears of a component of type cylindrical_stage.
struct GearPair {
    const RexsComponent *stage = nullptr, *gear_1 = nullptr, *gear_2 = nullptr;
};

std::map<const RexsComponent*, GearPair> gear_pairs(const RexsModel& model) {
    std::map<const RexsComponent*, GearPair> pairs;
    for (const RexsRelation& relation : model.relations) {
        const RexsComponent* stage =
            relation.type == "stage" ? model.component(relation.part("stage")) : nullptr;
        if (stage != nullptr) {
            pairs[stage] = {stage, model.component(relation.part("gear_1")),
                            model.component(relation.part("gear_2"))};
        }
    }
    return pairs;
}

std::string teeth_text(RexsValues& values, const Components& gears) {
    std::string text;
    for (const RexsComponent* gear : gears) {
        const RexsAttribute* teeth = gear == nullptr ? nullptr : gear->find("number_of_teeth");
        text +=
            (text.empty() ? "" : "/") +
            (teeth == nullptr
                 ? "?"
                 : fmt::format("{}", std::abs(values.count(*gear, "number_of_teeth").value_or(0))));
    }
    return text + " teeth";
}

bool contains(const Components& list, const RexsComponent* component) {
    return std::ranges::find(list, component) != list.end();
}

void add_once(Components& list, const RexsComponent* component) {
    if (!contains(list, component)) {
        list.push_back(component);
    }
}

bool is_ring(const RexsComponent* gear) {
    return gear->type == "ring_gear";
}

// Sorts the pairs of a planetary stage by mesh and finds sun, planets and ring.
RexsStage planetary_stage(RexsValues& values, const RexsComponent& component,
                          const std::vector<GearPair>& pairs) {
    RexsStage stage;
    stage.kind = RexsStageKind::planetary;
    stage.component = &component;
    Components suns, rings;
    constexpr std::size_t kMostPairs = 200;
    if (pairs.size() > kMostPairs) {
        stage.obstacle = fmt::format("it has {} gear pairs", pairs.size());
        return stage;
    }
    for (const GearPair& pair : pairs) {
        if (pair.gear_1 == nullptr || pair.gear_2 == nullptr) {
            stage.obstacle = pair.stage->label() + " names no gear_1 or no gear_2";
            return stage;
        }
        const bool first_is_ring = is_ring(pair.gear_1);
        if (first_is_ring || is_ring(pair.gear_2)) {
            add_once(rings, first_is_ring ? pair.gear_1 : pair.gear_2);
            add_once(stage.planets, first_is_ring ? pair.gear_2 : pair.gear_1);
            stage.second_pairs.push_back(pair.stage);
        } else {
            stage.first_pairs.push_back(pair.stage);
        }
    }
    for (const GearPair& pair : pairs) {
        if (!contains(stage.first_pairs, pair.stage)) {
            continue;
        }
        const bool planet_1 = contains(stage.planets, pair.gear_1),
                   planet_2 = contains(stage.planets, pair.gear_2);
        if (planet_1 == planet_2) {
            stage.obstacle =
                fmt::format("in {} {} and {}, so that the planets are stepped or paired",
                            pair.stage->label(), pair.gear_1->label(),
                            planet_1 ? pair.gear_2->label() + " mesh, both planets"
                                     : pair.gear_2->label() + " mesh, neither of them with a ring");
        } else {
            add_once(suns, planet_1 ? pair.gear_2 : pair.gear_1);
        }
    }
    if (stage.obstacle.empty() && (suns.size() != 1 || rings.size() != 1)) {
        stage.obstacle =
            fmt::format("it has {} suns and {} rings, not one of each", suns.size(), rings.size());
    }
    if (!stage.obstacle.empty()) {
        return stage;
    }
    stage.first = suns.front();
    stage.second = rings.front();
    stage.teeth =
        teeth_text(values, {stage.first, stage.planets.front(), stage.second}) +
        fmt::format(", {} planet{}", stage.planets.size(), stage.planets.size() == 1 ? "" : "s");
    if (stage.planets.size() != stage.first_pairs.size() ||
        stage.planets.size() != stage.second_pairs.size()) {
        stage.obstacle =
            fmt::format("{} planets have {} meshes with the sun and {} with the ring",
                        stage.planets.size(), stage.first_pairs.size(), stage.second_pairs.size());
    }
    return stage;
}

RexsStage cylindrical_stage(RexsValues& values, const GearPair& pair) {
    RexsStage stage;
    stage.kind = RexsStageKind::cylindrical;
    stage.component = pair.stage;
    stage.first = pair.gear_1;
    stage.second = pair.gear_2;
    stage.first_pairs = {pair.stage};
    if (pair.gear_1 == nullptr || pair.gear_2 == nullptr) {
        stage.obstacle = "it names no gear_1 or no gear_2";
        return stage;
    }
    stage.teeth = teeth_text(values, {pair.gear_1, pair.gear_2});
    if (is_ring(pair.gear_1) || is_ring(pair.gear_2)) {
        stage.obstacle = "internal gears on fixed shafts are not simulated";
    }
    return stage;
}

}  // namespace

std::string RexsStage::description() const {
    const std::string name = component->name.empty() ? "" : component->name + ", ";
    return fmt::format("{} ({}{}{}{})", component->id, name,
                       kind == RexsStageKind::planetary ? "planetary" : component->type,
                       teeth.empty() ? "" : ", " + teeth,
                       obstacle.empty() ? "" : "; not possible: " + obstacle);
}

std::vector<RexsStage> rexs_stages(RexsValues& values) {
    const RexsModel& model = values.model();
    const std::map<const RexsComponent*, GearPair> pairs = gear_pairs(model);
    std::map<const RexsComponent*, std::vector<GearPair>> planetary;
    std::set<const RexsComponent*> within;
    for (const RexsRelation& relation : model.relations) {
        const RexsComponent* whole =
            relation.type == "assembly" ? model.component(relation.part("assembly")) : nullptr;
        const RexsComponent* part = model.component(relation.part("part"));
        const auto pair = pairs.find(part);
        if (whole != nullptr && whole->type == "planetary_stage" && pair != pairs.end() &&
            within.insert(part).second) {
            planetary[whole].push_back(pair->second);
        }
    }
    std::vector<RexsStage> stages;
    for (const RexsComponent& component : model.components) {
        if (component.type == "planetary_stage") {
            stages.push_back(planetary_stage(values, component, planetary[&component]));
        } else if (component.type == "cylindrical_stage" && !within.contains(&component)) {
            const auto pair = pairs.find(&component);
            stages.push_back(cylindrical_stage(
                values, pair == pairs.end() ? GearPair{&component} : pair->second));
        } else if (component.type.ends_with("_stage") && !within.contains(&component)) {
            RexsStage other;
            other.component = &component;
            other.obstacle = "only planetary and cylindrical stages are simulated";
            stages.push_back(other);
        }
    }
    return stages;
}

const RexsComponent* rexs_shaft_of(const RexsModel& model, const RexsComponent& part) {
    for (const RexsComponent* whole : model.related("assembly", "part", part.id, "assembly")) {
        if (whole->type == "shaft") {
            return whole;
        }
    }
    return nullptr;
}

}  // namespace gearpod::mc
