#include "analysis/report/report_json.hpp"

#include <nlohmann/json.hpp>

namespace gearpod::analysis {
namespace {

nlohmann::json block_json(const Statement& statement) {
    return {{"key", statement.key}, {"text", statement.text}};
}

nlohmann::json block_json(const Table& table) {
    return {{"key", table.key},
            {"title", table.title},
            {"columns", table.columns},
            {"rows", table.rows},
            {"labels", table.labels}};
}

}  // namespace

nlohmann::json findings_json(const Report& report) {
    nlohmann::json sections = nlohmann::json::array();
    for (const Section& section : report.sections) {
        nlohmann::json blocks = nlohmann::json::array();
        for (const auto& block : section.blocks) {
            blocks.push_back(
                std::visit([](const auto& shown) { return block_json(shown); }, block));
        }
        sections.push_back({{"key", section.key}, {"title", section.title}, {"blocks", blocks}});
    }
    return sections;
}

}  // namespace gearpod::analysis
