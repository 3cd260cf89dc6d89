#include "mc/results/run_identity.hpp"

#include <fmt/format.h>

#include <sstream>

#include "mc/results/provenance.hpp"

namespace gearpod::mc {
std::string line_difference(const std::string& there, const std::string& here,
                            const std::string& where_there) {
    std::istringstream one(there), two(here);
    std::string a, b;
    do {
        const bool more_a = static_cast<bool>(std::getline(one, a));
        const bool more_b = static_cast<bool>(std::getline(two, b));
        if (!more_a && !more_b) {
            return "";
        }
        a = more_a ? a : "nothing";
        b = more_b ? b : "nothing";
    } while (a == b);
    return fmt::format("\"{}\" {}, \"{}\" here", a, where_there, b);
}

RunIdentity run_identity(const Study& study, const RowShape& shape, const Part& part) {
    Study essence = study;
    essence.title.clear();
    for (PythonFeature& one : essence.features.python) {
        one.file.clear();  // the hash of its content counts
    }
    essence.numerics.threads = Numerics{}.threads;
    essence.numerics.lanes = Numerics{}.lanes;
    essence.numerics.instruction_set = Numerics{}.instruction_set;
    essence.ensemble = {};
    essence.ensemble.threshold_instances = study.ensemble.threshold_instances;
    essence.ensemble.sampling = study.ensemble.sampling;
    essence.ensemble.threshold_records = study.ensemble.threshold_records;
    essence.ensemble.importance_sampling = study.ensemble.importance_sampling;
    return {version_text(), std::to_string(study.ensemble.seed), resolved_text(essence), shape,
            part.text()};
}

std::string difference(const RunIdentity& there, const RunIdentity& here) {
    if (there.version != here.version) {
        return fmt::format("was made by {}, this is {}", there.version, here.version);
    }
    if (there.study != here.study) {
        return fmt::format("belongs to another study ({})",
                           line_difference(there.study, here.study));
    }
    if (there.seed != here.seed) {
        return fmt::format("has seed {}, this run has {}", there.seed, here.seed);
    }
    if (there.part != here.part) {
        const auto named = [](const std::string& part) {
            return part.empty() ? "the whole ensemble" : "part " + part;
        };
        return fmt::format("has {}, this is {}", named(there.part), named(here.part));
    }
    return there.shape == here.shape ? "" : "has rows with other columns";
}

}  // namespace gearpod::mc
