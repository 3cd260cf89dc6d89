#include "bench_scene.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "mc/numerics/numerics_choice.hpp"

namespace gearpod::bench {

std::unique_ptr<mc::Scene> study_scene(const std::string& study,
                                       const std::vector<std::string>& overrides) {
    const std::string path = std::string(GEARPOD_SOURCE_DIR "/studies/") + study;
    const mc::StudyReading reading = mc::read_study(path, overrides);
    if (!reading.study) {
        throw std::runtime_error(mc::format(reading.problems));
    }
    return std::make_unique<mc::Scene>(mc::resolved_plan(*reading.study));
}

std::unique_ptr<mc::Scene> reference_scene(int planets, std::vector<std::string> overrides) {
    overrides.push_back(fmt::format("gearbox.planets={}", planets));
    if (planets == 3) {
        overrides.insert(overrides.end(), {"gearbox.sun.teeth=20", "gearbox.ring.teeth=82"});
    } else if (planets == 6) {
        overrides.insert(overrides.end(), {"gearbox.sun.teeth=40", "gearbox.planet.teeth=20",
                                           "gearbox.ring.teeth=80"});
    } else if (planets != 4) {
        throw std::runtime_error(fmt::format("no teeth are known for {} planets", planets));
    }
    return study_scene("reference-10k.toml", overrides);
}

}  // namespace gearpod::bench
