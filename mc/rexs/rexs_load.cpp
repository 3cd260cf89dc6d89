#include "mc/rexs/rexs_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

namespace gearpod::mc {
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
