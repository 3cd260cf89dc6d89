#include "mc/study/rexs/rexs_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
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

namespace {

using Shaft = const RexsComponent*;

// Connection of two shafts: speed of `to` divided by that of `from`.
struct Link {
    Shaft to = nullptr;
    double ratio = 1;
};
using Links = std::map<Shaft, std::vector<Link>>;

void connect(Links& links, Shaft a, Shaft b, double b_over_a) {
    if (a != nullptr && b != nullptr && a != b && b_over_a > 0.0) {
        links[a].push_back({b, b_over_a});
        links[b].push_back({a, 1.0 / b_over_a});
    }
}

double teeth_of_gear(RexsValues& values, const RexsComponent& gear) {
    return std::abs(values.count(gear, "number_of_teeth").value_or(0));
}

Links shaft_links(RexsValues& values, const std::vector<RexsStage>& stages) {
    const RexsModel& model = values.model();
    Links links;
    for (const RexsStage& stage : stages) {
        if (stage.first == nullptr || stage.second == nullptr) {
            continue;
        }
        const double first = teeth_of_gear(values, *stage.first),
                     second = teeth_of_gear(values, *stage.second);
        Shaft shaft = rexs_shaft_of(model, *stage.first);
        if (stage.kind == RexsStageKind::cylindrical) {
            connect(links, shaft, rexs_shaft_of(model, *stage.second), first / second);
        } else {
            for (Shaft carrier : rexs_carrier_shafts(model, stage)) {
                connect(links, shaft, carrier, first / (first + second));
            }
        }
    }
    for (const RexsRelation& relation : model.relations) {
        const RexsComponent* between =
            relation.type == "side" ? model.component(relation.part("assembly")) : nullptr;
        if (between == nullptr || !between->type.ends_with("coupling") ||
            !values.flag(*between, "is_engaged").value_or(true)) {
            continue;
        }
        Shaft inner = model.component(relation.part("inner_part")),
              outer = model.component(relation.part("outer_part"));
        if (inner != nullptr && outer != nullptr && inner->type == "shaft" &&
            outer->type == "shaft") {
            connect(links, inner, outer, 1.0);
        }
    }
    return links;
}

// Ratio of the speed of each shaft that can be reached to that of `start`, and the number of links
// between them.
struct Reached {
    double ratio = 1;
    int links = 0;
};
std::map<Shaft, Reached> reached_from(const Links& links, Shaft start) {
    std::map<Shaft, Reached> reached{{start, {}}};
    std::deque<Shaft> next{start};
    while (!next.empty()) {
        const Shaft here = next.front();
        next.pop_front();
        const auto from = links.find(here);
        if (from == links.end()) {
            continue;
        }
        for (const Link& link : from->second) {
            const Reached there{reached.at(here).ratio * link.ratio, reached.at(here).links + 1};
            if (reached.emplace(link.to, there).second) {
                next.push_back(link.to);
            }
        }
    }
    return reached;
}

struct Stated {
    Shaft shaft = nullptr;
    const RexsComponent* by = nullptr;
    double value = 0;  // signed
    bool defines = false;
};

std::vector<Stated> stated_speeds(RexsValues& values) {
    std::vector<Stated> speeds;
    for (const RexsComponent& shaft : values.model().components) {
        if (shaft.type != "shaft") {
            continue;
        }
        const auto speed = values.number(shaft, "rotational_speed", RexsQuantity::speed);
        const bool defines = values.flag(shaft, "defines_speed").value_or(false);
        if (speed && *speed != 0.0) {
            speeds.push_back({&shaft, &shaft, *speed, defines});
        }
    }
    return speeds;
}

// Shafts by the ids of their parts.
std::map<std::string, Shaft> shafts_by_part(const RexsModel& model) {
    std::map<std::string, Shaft> shafts;
    for (const RexsRelation& relation : model.relations) {
        const Shaft whole =
            relation.type == "assembly" ? model.component(relation.part("assembly")) : nullptr;
        if (whole != nullptr && whole->type == "shaft") {
            shafts.emplace(relation.part("part"), whole);
        }
    }
    return shafts;
}

std::vector<Stated> stated_torques(RexsValues& values) {
    const std::map<std::string, Shaft> shafts = shafts_by_part(values.model());
    std::vector<Stated> torques;
    for (const RexsComponent& load : values.model().components) {
        if (load.type != "external_load") {
            continue;
        }
        values.consider(load);
        values.flag(load, "transmits_torque");
        const bool defines = values.flag(load, "defines_torque").value_or(false);
        const auto torque = values.number(load, "torque_around_u_axis", RexsQuantity::torque);
        const auto shaft = shafts.find(load.id);
        if (torque && *torque != 0.0 && shaft != shafts.end()) {
            torques.push_back({shaft->second, &load, *torque, defines});
        }
    }
    // Loads that define the torque come first.
    std::ranges::stable_partition(torques, [](const Stated& torque) { return torque.defines; });
    return torques;
}

// Driving and driven shafts of a stage.
std::vector<Shaft> shafts(const RexsModel& model, const RexsStage& stage, bool second) {
    if (second && stage.kind == RexsStageKind::planetary) {
        return rexs_carrier_shafts(model, stage);
    }
    const Shaft shaft = rexs_shaft_of(model, second ? *stage.second : *stage.first);
    return shaft == nullptr ? std::vector<Shaft>{} : std::vector{shaft};
}

const Reached* found(const std::map<Shaft, Reached>& reached, const std::vector<Shaft>& list) {
    const Reached* nearest = nullptr;
    for (const Shaft shaft : list) {
        const auto at = reached.find(shaft);
        if (at != reached.end() && (nearest == nullptr || at->second.links < nearest->links)) {
            nearest = &at->second;
        }
    }
    return nearest;
}

// True if the stage data call gear_2 the driving one.
bool second_is_driving(RexsValues& values, const RexsStage& stage) {
    if (stage.kind == RexsStageKind::planetary) {
        return false;
    }
    for (const RexsComponent* data :
         values.model().related("stage_gear_data", "gear", stage.second->id, "stage_gear_data")) {
        if (values.flag(*data, "is_driving_gear").value_or(false)) {
            return true;
        }
    }
    return false;
}

}  // namespace

std::vector<const RexsComponent*> rexs_carrier_shafts(const RexsModel& model,
                                                      const RexsStage& stage) {
    return model.related("planet_carrier_shaft", "planetary_stage", stage.component->id, "shaft");
}

RexsLoad rexs_load(RexsValues& values, const std::vector<RexsStage>& stages,
                   const RexsStage& stage) {
    constexpr double kSpeedAgrees = 0.01, kTorqueAgrees = 0.2;  // losses lower a torque
    const RexsModel& model = values.model();
    const Links links = shaft_links(values, stages);
    const std::vector<Stated> speeds = stated_speeds(values), torques = stated_torques(values);
    RexsLoad load;
    load.second_drives = second_is_driving(values, stage);
    if (!torques.empty()) {
        const Stated& torque = torques.front();
        const auto reached = reached_from(links, torque.shaft);
        const Reached* first = found(reached, shafts(model, stage, false));
        const Reached* second = found(reached, shafts(model, stage, true));
        const auto speed = std::ranges::find(speeds, torque.shaft, &Stated::shaft);
        const bool drives = speed == speeds.end() || speed->value * torque.value > 0.0;
        if (first != nullptr && second != nullptr) {
            load.second_drives = (second->links < first->links) == drives;
            const Reached& driver = load.second_drives ? *second : *first;
            load.torque_N_m = std::abs(torque.value) / driver.ratio;
            load.notes.push_back(
                fmt::format("torque from {} ({:.6g} N m)", torque.by->label(), torque.value));
        }
        for (const Stated& other : torques) {
            const auto at = reached.find(other.shaft);
            if (&other == &torque || at == reached.end()) {
                continue;
            }
            const double expected = std::abs(torque.value) / at->second.ratio;
            if (std::abs(std::abs(other.value) - expected) > kTorqueAgrees * expected) {
                load.notes.push_back(
                    fmt::format("{} N m of {} are not used; {:.6g} N m follow from {}", other.value,
                                other.by->label(), expected, torque.by->label()));
            }
        }
    }
    const std::vector<Shaft> drivers = shafts(model, stage, load.second_drives);
    const auto reached =
        drivers.empty() ? std::map<Shaft, Reached>{} : reached_from(links, drivers.front());
    const Stated* source = nullptr;
    for (const Stated& speed : speeds) {
        const auto at = reached.find(speed.shaft);
        if (at == reached.end()) {
            continue;
        }
        const double here = std::abs(speed.value) / at->second.ratio;
        if (!load.speed_rpm) {
            load.speed_rpm = here;
            source = &speed;
            load.notes.push_back(
                fmt::format("speed from {} ({:.6g} rpm)", speed.by->label(), speed.value));
        } else if (std::abs(here - *load.speed_rpm) > kSpeedAgrees * here) {
            values.reject(
                *speed.by, "rotational_speed",
                fmt::format("{:.6g} rpm contradict {:.6g} rpm of {}: the stage's driving "
                            "shaft would turn at {:.6g} and at {:.6g} rpm",
                            speed.value, source->value, source->by->label(), here, *load.speed_rpm),
                "correct one of them");
        }
    }
    return load;
}

std::string why_ring_turns(RexsValues& values, const RexsStage& stage) {
    const RexsModel& model = values.model();
    const Shaft shaft = rexs_shaft_of(model, *stage.second);
    if (shaft == nullptr) {
        return "";
    }
    const auto speed = values.number(*shaft, "rotational_speed", RexsQuantity::speed);
    if (speed && *speed != 0.0) {
        return fmt::format("its {} turns at {:.6g} rpm", shaft->label(), *speed);
    }
    for (const Shaft held : [&] {
             std::vector<Shaft> list = rexs_carrier_shafts(model, stage);
             list.push_back(rexs_shaft_of(model, *stage.first));
             return list;
         }()) {
        const auto still = held == nullptr
                               ? std::nullopt
                               : values.number(*held, "rotational_speed", RexsQuantity::speed);
        if (still && *still == 0.0 && values.flag(*held, "defines_speed").value_or(false)) {
            return fmt::format("{} stands still instead (rotational_speed 0)", held->label());
        }
    }
    return "";
}

}  // namespace gearpod::mc
