// lives STUDY: gearboxes that are measured again and again while a crack grows.
#include <fmt/format.h>

#include <exception>
#include <nlohmann/json.hpp>

#include "mc/commands/support.hpp"
#include "mc/ensemble/progress.hpp"
#include "mc/ensemble/thread_count.hpp"
#include "mc/files/json_text.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/lives/campaign.hpp"
#include "mc/report/lives_report.hpp"
#include "mc/scene/scene_error.hpp"

namespace gearpod::mc {

int lives_command(const LivesOptions& options) {
    const bool writable = can_write({"--json", options.json}, {{"the study", options.study.path}});
    const auto scene = load_scene(options.study).scene;
    if (!scene || !writable) {
        return kBadInput;
    }
    try {
        const Study& study = scene->study();
        const auto lives =
            static_cast<long>(study.ensemble.instances + study.ensemble.threshold_instances) +
            study.life.healthy_lives;
        Progress progress(lives, options.quiet);
        const Campaign campaign =
            run_campaign(*scene, thread_count(study), [&](long count) { progress.advance(count); });
        progress.finish();
        const auto monitored = monitor(study, campaign);
        if (!options.json.empty()) {
            const auto json = lives_json(study, campaign, monitored);
            if (!write_text_to(options.json, json_text(json, 2) + "\n")) {
                return kBadInput;
            }
        }
        if (options.json != "-") {
            fmt::print("{}", lives_text(study, campaign, monitored));
        }
        return campaign.failed > 0 ? kSomeFailed : kDone;
    } catch (const SceneError& error) {
        print_problems({{options.study.path, 0, error.key(), error.what(), error.remedy()}});
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
    }
    return kBadInput;
}

}  // namespace gearpod::mc
