#include "mc/study/elements/sensors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <span>

#include "mc/files/input/document.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/sensor_signal.hpp"
#include "signals/noise/bearing_impulses.hpp"

namespace gearpod::mc {

std::vector<HousingMode> read_housing_modes(const Value& list, const RejectElement& reject) {
    std::vector<HousingMode> modes;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        const ListElement element(
            list.elements[i], fmt::format("mode {}", i + 1), kHousingFields,
            "write { frequency_Hz = 420, damping = 0.03, participation = 0.8 }", reject);
        HousingMode mode;
        mode.frequency_Hz = element.number("frequency_Hz", {.low = 1.0});
        mode.damping = element.number("damping", {0.001, 1.0});
        mode.participation = element.number("participation", kParticipation);
        if (element.has("nodal_diameters")) {
            mode.nodal_diameters = element.integer("nodal_diameters", {0.0, 100.0});
        }
        for (const HousingBearing& bearing : kHousingBearings) {
            mode.*bearing.per_kg = element.number(bearing.per_kg_name, kParticipation, 0.0);
        }
        modes.push_back(mode);
    }
    return modes;
}

std::string housing_table(const HousingMode& mode) {
    std::string more =
        mode.nodal_diameters ? fmt::format(", nodal_diameters = {}", *mode.nodal_diameters) : "";
    for (const HousingBearing& bearing : kHousingBearings) {
        if (mode.*bearing.per_kg != 0.0) {
            more += fmt::format(", {} = {}", bearing.per_kg_name, mode.*bearing.per_kg);
        }
    }
    return fmt::format("{{ frequency_Hz = {}, damping = {}, participation = {}{} }}",
                       mode.frequency_Hz, mode.damping, mode.participation, more);
}

namespace {

constexpr Range kGain{.low = 0.0}, kPhase_deg{-1e6, 1e6};

void read_chain(const ListElement& element, AdditionalSensor& sensor) {
    const auto number = [&](const char* name, const Range& range) {
        return element.has(name) ? std::optional(element.number(name, range)) : std::nullopt;
    };
    sensor.sampling_Hz = number("sampling_Hz", kAbove0);
    sensor.low_pass_Hz = number("low_pass_Hz", kAbove0);
    sensor.mounting_Hz = number("mounting_Hz", {.low = 1.0});
    sensor.mounting_damping =
        element.number("mounting_damping", {0.001, 1.0}, sensor.mounting_damping);
    if (element.has("mounting_damping") && !sensor.mounting_Hz) {
        element.reject("mounting_damping is given, but no mounting_Hz",
                       "give the natural frequency of the mounting, too");
    }
    sensor.delay_s = element.number("delay_s", {-1.0, 1.0}, 0.0);
    sensor.quantisation_m_s2 = number("quantisation_m_s2", {.low = 0.0});
    sensor.range_m_s2 = number("range_m_s2", kAbove0);
}

// Entries of the measuring chain in a table.
std::string chain_text(const AdditionalSensor& sensor) {
    std::string text;
    const auto add = [&](const char* name, std::optional<double> value) {
        text += value ? fmt::format(", {} = {}", name, *value) : "";
    };
    add("sampling_Hz", sensor.sampling_Hz);
    add("low_pass_Hz", sensor.low_pass_Hz);
    add("mounting_Hz", sensor.mounting_Hz);
    if (sensor.mounting_Hz) {
        add("mounting_damping", sensor.mounting_damping);
    }
    if (sensor.delay_s != 0.0) {
        add("delay_s", sensor.delay_s);
    }
    add("quantisation_m_s2", sensor.quantisation_m_s2);
    add("range_m_s2", sensor.range_m_s2);
    return text;
}

Bearing read_bearing(const ListElement& element) {
    Bearing bearing;
    bearing.fault =
        static_cast<BearingFault>(element.choice("fault", kBearingFaults, true).value_or(0));
    if (element.first_of("shaft", "shaft_Hz")) {
        bearing.shaft = element.shaft();
    } else if (element.has("shaft_Hz")) {
        bearing.shaft_Hz = element.number("shaft_Hz", kAbove0);
    }
    bearing.elements = element.integer("elements", {3.0, 1000.0});
    bearing.diameter_ratio = element.number("diameter_ratio", {0.01, 0.9});
    bearing.contact_angle_deg = element.number("contact_angle_deg", {0.0, 60.0}, 0.0);
    bearing.amplitude_m_s2 = element.number("amplitude_m_s2", kAbove0);
    bearing.resonance_Hz = element.number("resonance_Hz", {.low = 1.0});
    bearing.damping = element.number("damping", {0.001, signals::kMostResonanceDamping}, 0.05);
    bearing.slip = element.number("slip", {0.0, signals::kMostSlip}, 0.01);
    bearing.load_zone_deg = element.number("load_zone_deg", {0.0, 360.0, true}, 180.0);
    if (element.has("load_zone_deg") && load_turns_per_turn(bearing) == 0.0) {
        element.reject("load_zone_deg has no effect: the load of this part is constant",
                       "remove it, or use fault = \"inner\" or \"roller\"");
    }
    bearing.role = static_cast<SourceRole>(element.choice("role", kSourceRoles, false).value_or(0));
    return bearing;
}

// Study of a stage: name in messages, and text.
struct StageText {
    std::string name, text;
};

// Empty if the study is missing or cannot be read, which is rejected.
std::optional<StageText> stage_text(const ListElement& element, const Value& table) {
    const bool in_file = element.first_of("study", "text");
    const auto given = element.text(in_file ? "study" : "text");
    if (!given) {
        return std::nullopt;
    }
    if (!in_file) {
        return StageText{"its study", *given};
    }
    const auto folder = std::filesystem::path(table.position.file).parent_path();
    StageText found{(folder / *given).lexically_normal().string(), ""};
    Problems problems;
    found.text = read_file(found.name, problems);
    for (const Problem& problem : problems) {
        element.reject(found.name + ": " + problem.what, problem.remedy);
    }
    return problems.empty() ? std::optional(std::move(found)) : std::nullopt;
}

bool gives(const Value& document, const char* section, const char* key) {
    const Entry* entry = document.find(section);
    return entry != nullptr && entry->value.find(key) != nullptr;
}

void read_stage_study(const ListElement& element, const Value& table, NeighbourStage& stage) {
    const auto found = stage_text(element, table);
    if (!found) {
        return;
    }
    const auto& [name, text] = *found;
    if (text.empty()) {
        element.reject(name + " is empty", "name the study of that stage");
        return;
    }
    Problems of_text;
    const Value document = parse_document(text, name, of_text);
    if (gives(document, "sensor", "stages")) {
        element.reject(name + " has stages of its own (sensor.stages)",
                       "list all stages in one study");
        return;
    }
    if (gives(document, "features", "python")) {
        element.reject(name + " has features in Python, but only its vibration is used",
                       "remove features.python there");
        return;
    }
    StudyReading reading = read_study_text(text, name);
    if (!reading.study) {
        element.reject("its study has problems:\n" + format(reading.problems), "");
        return;
    }
    if (!has_gears(*reading.study) || reading.study->effects.quasi_static()) {
        element.reject(name + " has no gears whose vibration can be computed",
                       "give tooth numbers and another effects.motion than quasi-static");
        return;
    }
    stage.text = resolved_text(*reading.study);
    stage.study = std::make_shared<const Study>(*std::move(reading.study));
}

NeighbourStage read_stage(const ListElement& element, const Value& table) {
    NeighbourStage stage;
    stage.name = element.word("name");
    stage.shaft = element.shaft();
    stage.stage_shaft = element.shaft("stage_shaft");
    stage.of = element.has("of") ? element.word("of") : "";
    stage.gain = element.number("gain", kAbove0, 1.0);
    stage.shaft_stiffness_N_m_rad = element.number("shaft_stiffness_N_m_rad", {.low = 0.0}, 0.0);
    stage.shaft_damping_ratio =
        element.number("shaft_damping_ratio", {.low = 0.0, .high = 1.0, .low_open = true}, 0.02);
    if (element.has("shaft_damping_ratio") && !element.has("shaft_stiffness_N_m_rad")) {
        element.reject("shaft_damping_ratio has no effect without shaft_stiffness_N_m_rad",
                       "give both, or neither");
    }
    stage.role = static_cast<SourceRole>(element.choice("role", kSourceRoles, false).value_or(0));
    read_stage_study(element, table, stage);
    if (stage.study && stage.role == SourceRole::other_fault &&
        stage.study->fault.kind == nullptr) {
        element.reject("role = \"other_fault\", but its study has no [fault]", "add one");
    }
    return stage;
}

}  // namespace

std::vector<AdditionalSensor> read_additional_sensors(const Value& list,
                                                      const RejectElement& reject) {
    std::vector<AdditionalSensor> sensors;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        const ListElement element(list.elements[i], fmt::format("sensor {}", i + 1), kSensorFields,
                                  "write { name = \"side\", angle_deg = 90 }", reject);
        AdditionalSensor sensor;
        sensor.name = element.word("name");
        if (sensor.name == "first") {
            element.reject("the name \"first\" is that of the study's own sensor",
                           "use another name");
        }
        if (std::ranges::find(sensors, sensor.name, &AdditionalSensor::name) != sensors.end() &&
            !sensor.name.empty()) {
            element.reject(fmt::format("another one has the name \"{}\", too", sensor.name),
                           "give each its own");
        }
        sensor.angle_deg = element.number("angle_deg", {-360.0, 360.0});
        sensor.tangential = element.choice("direction", kDirections, false).value_or(0) == 1;
        sensor.gain = element.number("gain", kAbove0, 1.0);
        sensor.noise = element.number("noise", {.low = 0.0}, 1.0);
        sensor.participation = element.numbers("participation", kParticipation);
        sensor.response_gain = element.numbers("response_gain", kGain);
        sensor.response_phase_deg = element.numbers("response_phase_deg", kPhase_deg);
        for (const HousingBearing& bearing : kHousingBearings) {
            sensor.*bearing.own_per_kg = element.numbers(bearing.per_kg_name, kParticipation);
            sensor.*bearing.own_gain = element.numbers(bearing.gain_name, kGain);
            sensor.*bearing.own_phase_deg = element.numbers(bearing.phase_name, kPhase_deg);
        }
        read_chain(element, sensor);
        sensors.push_back(sensor);
    }
    return sensors;
}

std::string sensor_table(const AdditionalSensor& sensor) {
    const auto list = [](const char* name, const std::vector<double>& values) {
        return values.empty() ? std::string()
                              : fmt::format(", {} = [{}]", name, fmt::join(values, ", "));
    };
    std::string bearings;
    for (const HousingBearing& bearing : kHousingBearings) {
        bearings += list(bearing.per_kg_name, sensor.*bearing.own_per_kg) +
                    list(bearing.gain_name, sensor.*bearing.own_gain) +
                    list(bearing.phase_name, sensor.*bearing.own_phase_deg);
    }
    return fmt::format(
        "{{ name = \"{}\", angle_deg = {}, direction = \"{}\", gain = {}, noise = {}{}{}{}{}{} }}",
        sensor.name, sensor.angle_deg, kDirections[sensor.tangential ? 1 : 0].text, sensor.gain,
        sensor.noise, list("participation", sensor.participation),
        list("response_gain", sensor.response_gain),
        list("response_phase_deg", sensor.response_phase_deg), bearings, chain_text(sensor));
}

std::vector<Tone> read_tones(const Value& list, const RejectElement& reject) {
    std::vector<Tone> tones;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        const ListElement element(list.elements[i], fmt::format("tone {}", i + 1), kToneFields,
                                  "write { frequency_Hz = 50, amplitude_m_s2 = 0.1 }", reject);
        Tone tone;
        if (element.has("shaft") || element.has("order")) {
            element.first_of("shaft", "frequency_Hz");
            tone.shaft = element.has("shaft") ? element.shaft() : std::nullopt;
            tone.order = element.number("order", kAbove0);
        } else {
            tone.frequency_Hz = element.number("frequency_Hz", kAbove0);
        }
        tone.amplitude_m_s2 = element.number("amplitude_m_s2", kAbove0);
        tones.push_back(tone);
    }
    return tones;
}

std::string tone_table(const Tone& tone) {
    return tone.shaft ? fmt::format("{{ shaft = \"{}\", order = {}, amplitude_m_s2 = {} }}",
                                    member_name(*tone.shaft), tone.order, tone.amplitude_m_s2)
                      : fmt::format("{{ frequency_Hz = {}, amplitude_m_s2 = {} }}",
                                    tone.frequency_Hz, tone.amplitude_m_s2);
}

std::vector<Bearing> read_bearings(const Value& list, const RejectElement& reject) {
    std::vector<Bearing> bearings;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        bearings.push_back(read_bearing(ListElement(
            list.elements[i], fmt::format("bearing {}", i + 1), kBearingFields,
            "write { fault = \"outer\", shaft = \"sun\", elements = 9, diameter_ratio = 0.2, "
            "amplitude_m_s2 = 3, resonance_Hz = 2500 }",
            reject)));
    }
    return bearings;
}

std::string bearing_table(const Bearing& bearing) {
    return fmt::format(
        "{{ fault = \"{}\", {}, elements = {}, diameter_ratio = {}, contact_angle_deg = {}, "
        "amplitude_m_s2 = {}, resonance_Hz = {}, damping = {}, slip = {}, {}role = \"{}\" }}",
        kBearingFaults[static_cast<std::size_t>(bearing.fault)].text,
        bearing.shaft ? fmt::format("shaft = \"{}\"", member_name(*bearing.shaft))
                      : fmt::format("shaft_Hz = {}", bearing.shaft_Hz),
        bearing.elements, bearing.diameter_ratio, bearing.contact_angle_deg, bearing.amplitude_m_s2,
        bearing.resonance_Hz, bearing.damping, bearing.slip,
        load_turns_per_turn(bearing) > 0.0
            ? fmt::format("load_zone_deg = {}, ", bearing.load_zone_deg)
            : "",
        kSourceRoles[static_cast<std::size_t>(bearing.role)].text);
}

std::vector<NeighbourStage> read_stages(const Value& list, const RejectElement& reject) {
    std::vector<NeighbourStage> stages;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        const ListElement element(list.elements[i], fmt::format("stage {}", i + 1), kStageFields,
                                  "write { name = \"first\", study = \"first-stage.toml\", shaft = "
                                  "\"sun\", stage_shaft = \"carrier\" }",
                                  reject);
        stages.push_back(read_stage(element, list.elements[i]));
        const auto is_earlier = [&](const std::string& name) {
            return std::ranges::count(std::span(stages).first(i), name, &NeighbourStage::name) > 0;
        };
        if (is_earlier(stages[i].name)) {
            element.reject("its name \"" + stages[i].name + "\" occurs twice", "rename one");
        }
        if (!stages[i].of.empty() && !is_earlier(stages[i].of)) {
            element.reject("of: no earlier stage has the name \"" + stages[i].of + "\"",
                           "list the stages in the order of their shafts");
        }
        const auto other = std::ranges::find(stages, stages[i].of, &NeighbourStage::name);
        if (stages[i].coupled() && !stages[i].of.empty() && other != stages.end() &&
            !other->coupled()) {
            element.reject(
                fmt::format("shaft_stiffness_N_m_rad: the shaft of stage \"{}\" has none",
                            other->name),
                "give it one, too: elastic shafts must lead to the study's gearbox");
        }
    }
    return stages;
}

std::string stage_table(const NeighbourStage& stage) {
    return fmt::format(
        "{{ name = \"{}\", text = {}, shaft = \"{}\", {}stage_shaft = \"{}\", gain = {}, {}role = "
        "\"{}\" }}",
        stage.name, quoted_text(stage.text), member_name(*stage.shaft),
        stage.of.empty() ? "" : fmt::format("of = \"{}\", ", stage.of),
        member_name(*stage.stage_shaft), stage.gain,
        stage.coupled() ? fmt::format("shaft_stiffness_N_m_rad = {}, shaft_damping_ratio = {}, ",
                                      stage.shaft_stiffness_N_m_rad, stage.shaft_damping_ratio)
                        : "",
        kSourceRoles[static_cast<std::size_t>(stage.role)].text);
}

}  // namespace gearpod::mc
