#include "mc/python/simulate_rows.hpp"

#include <fmt/format.h>

#include <atomic>
#include <thread>

#include "machine/team.hpp"
#include "mc/ensemble/thread_count.hpp"
#include "mc/input/bad_input.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/library/simulated_row.hpp"

namespace gearpod::python {
namespace {

void append(std::vector<double>& all, const std::vector<double>& values) {
    all.insert(all.end(), values.begin(), values.end());
}

void append(mc::Simulation& all, const mc::Simulation& one) {
    for (std::size_t c = 0; c < all.columns.size(); ++c) {
        append(all.columns[c].values, one.columns[c].values);
    }
    for (std::size_t m = 0; m < all.contact_loss.size(); ++m) {
        append(all.contact_loss[m].values, one.contact_loss[m].values);
    }
    append(all.features, one.features);
}

}  // namespace

mc::Simulation simulate_rows(const mc::Scene& scene, const std::vector<long>& rows, long meshes,
                             const std::function<bool()>& interrupted) {
    std::vector<mc::Simulation> each(rows.size());
    std::atomic<bool> stopped{false};
    const auto caller = std::this_thread::get_id();
    machine::for_each_index(rows.size(), mc::thread_count(scene.study()), [&](std::size_t i) {
        if (std::this_thread::get_id() == caller && interrupted()) {
            stopped = true;
        }
        if (stopped) {
            return;
        }
        try {
            each[i] = mc::simulate_row(scene, rows[i], meshes);
        } catch (const mc::BadInput&) {
            stopped = true;
            throw;
        } catch (const std::exception& error) {
            stopped = true;
            throw GearboxFailed(fmt::format("row {}: {}", rows[i], mc::exception_text(error)));
        }
    });
    if (stopped || each.empty()) {
        return {};
    }
    mc::Simulation all = std::move(each.front());
    for (std::size_t i = 1; i < each.size(); ++i) {
        append(all, each[i]);
        each[i] = {};
    }
    return all;
}

}  // namespace gearpod::python
