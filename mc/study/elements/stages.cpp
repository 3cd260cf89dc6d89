#include "mc/study/elements/stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>

#include "mc/input/document.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

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

// True if the document gives that key.
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
