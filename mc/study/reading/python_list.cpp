#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "mc/files/input/spelling.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/python/python_worker.hpp"
#include "mc/study/reading/parts.hpp"

namespace gearpod::mc {
namespace {

using features::BaselineUse;
using features::Feature;

const std::vector<std::string_view> kPythonNames{"name",  "file", "sha256", "title",  "unit",
                                                 "alarm", "uses", "doc",    "samples"};
constexpr std::string_view kModules = "modules";
constexpr auto kWithSamples = features::SignalSet::of<features::TeTurn, features::SensorSamples>();

class PythonList {
  public:
    PythonList(bool runs, const RejectElement& reject) : runs_(runs), reject_(reject) {}

    void add(const Value& element) {
        at_ = element.position;
        if (element.kind == Value::Kind::text) {
            add_file(element);
        } else if (element.kind == Value::Kind::table) {
            add_table(element);
        } else {
            reject(fmt::format("must be a list of files, but contains {}", element.shown()),
                   "write [\"my_features.py\"]");
        }
    }
    std::vector<PythonFeature> take() && { return std::move(all_); }

  private:
    void add_file(const Value& element) {
        if (!runs_) {
            reject(fmt::format("\"{}\" would be run, but the study is not in a file of its own",
                               element.text),
                   "name it in a study file");
            return;
        }
        const auto folder = std::filesystem::path(element.position.file).parent_path();
        std::error_code none;
        const std::string path =
            std::filesystem::absolute(folder / element.text, none).lexically_normal().string();
        try {
            const PythonFile file = PythonWorker::of_thread().load(path);
            for (const PythonFunction& function : file.functions) {
                add(function, path, file.hashes);
            }
        } catch (const PythonError& error) {
            reject(printable(error.what()), "");
        }
    }

    void add_table(const Value& table) {
        std::vector<std::string> texts(kPythonNames.size()), modules;
        for (const Entry& entry : table.entries) {
            if (entry.name == kModules) {
                modules = texts_of(entry.value);
                continue;
            }
            const auto known = std::ranges::find(kPythonNames, entry.name);
            if (known == kPythonNames.end()) {
                reject(fmt::format("unknown key {}", entry.name),
                       suggest(entry.name, kPythonNames));
            } else if (entry.value.kind != Value::Kind::text) {
                reject(
                    fmt::format("{} must be a string, but is {}", entry.name, entry.value.shown()),
                    "");
            } else {
                texts[static_cast<std::size_t>(known - kPythonNames.begin())] = entry.value.text;
            }
        }
        if (texts[0].empty() || texts[1].empty() || texts[2].empty()) {
            reject("a table needs name, file and sha256", "name the file as a string instead");
            return;
        }
        add({texts[0], texts[3], texts[4], texts[5], texts[6], texts[7], texts[8]}, texts[1],
            {texts[2], std::move(modules)});
    }

    std::vector<std::string> texts_of(const Value& list) const {
        std::vector<std::string> texts;
        for (const Value& element : list.elements) {
            texts.push_back(element.text);
        }
        if (list.kind != Value::Kind::array ||
            std::ranges::any_of(texts, [](const std::string& text) {
                return text.find(' ') == std::string::npos;
            })) {
            reject(fmt::format("{} must be a list of files with their hashes", kModules),
                   "write [\"helper.py SHA-256\"]");
        }
        return texts;
    }

    void add(const PythonFunction& function, const std::string& path, PythonHashes hashes) {
        const auto same = std::ranges::find_if(
            all_, [&](const PythonFeature& one) { return one.feature->name == function.name; });
        const auto built_in = features::all_features();
        if (same != all_.end()) {
            reject(fmt::format("{}: \"{}\" is also in {}", path, function.name, same->file),
                   "rename one of them");
            return;
        }
        if (std::ranges::find(built_in, function.name, &Feature::name) != built_in.end()) {
            reject(fmt::format("{}: \"{}\" is a feature of the program", path, function.name),
                   "rename the function");
            return;
        }
        Feature feature{
            .name = function.name,
            .title = function.title,
            .unit = function.unit.empty() ? "1" : std::string_view(function.unit),
            .alarm = function.alarm == "low" ? features::AlarmSide::low : features::AlarmSide::high,
            .doc = function.doc,
            .needs = function.samples == "no" ? features::kBasicSignals : kWithSamples,
            .from_sensor = true,
            .external = true};
        feature.baseline_use =
            function.uses.find("change") != std::string::npos      ? BaselineUse::record_and_change
            : function.uses.find("baselines") != std::string::npos ? BaselineUse::baseline
                                                                   : BaselineUse::nothing;
        all_.push_back({path, std::move(hashes), &features::declare_feature(feature)});
    }

    void reject(std::string what, std::string remedy) const {
        reject_(at_, std::move(what), std::move(remedy));
    }

    const bool runs_;
    const RejectElement& reject_;
    Position at_;  // of the element that is being read
    std::vector<PythonFeature> all_;
};

}  // namespace

std::vector<PythonFeature> read_python_features(const Value& list, bool runs,
                                                const RejectElement& reject) {
    PythonList files(runs, reject);
    for (const Value& element : list.elements) {
        files.add(element);
    }
    return std::move(files).take();
}

std::string_view uses_text(const Feature& feature) {
    switch (feature.baseline_use) {
        case BaselineUse::baseline:
            return "record, baselines";
        case BaselineUse::change:
        case BaselineUse::record_and_change:
            return "record, baselines, change";
        case BaselineUse::nothing:
            break;
    }
    return "record";
}

}  // namespace gearpod::mc
