#include "lockstep/tile/superposed_motion.hpp"

#include <algorithm>

#include "machine/contracts.hpp"

namespace gearpod::lockstep {
namespace {

std::size_t index_in_period(int k, std::size_t period) {
    const auto length = static_cast<int>(period);
    return static_cast<std::size_t>((k % length + length) % length);
}

void add_up(std::span<const machine::AlignedVector* const> parts, machine::AlignedVector& sum) {
    const std::size_t size = sum.size();
    EXPECTS(std::ranges::all_of(parts, [&](const auto* part) { return part->size() == size; }));
    double* __restrict out = sum.data();
    if (parts.size() == 3) {  // a planetary train: one pass over memory
        const double* __restrict a = parts[0]->data();
        const double* __restrict b = parts[1]->data();
        const double* __restrict c = parts[2]->data();
#pragma omp simd
        for (std::size_t i = 0; i < size; ++i) {
            out[i] = a[i] + (b[i] + c[i]);
        }
        return;
    }
    std::fill_n(out, size, 0.0);
    for (const machine::AlignedVector* part : parts) {
        const double* __restrict values = part->data();
#pragma omp simd
        for (std::size_t i = 0; i < size; ++i) {
            out[i] += values[i];
        }
    }
}

void subtract(const machine::AlignedVector& less, machine::AlignedVector& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] -= less[i];
    }
}

}  // namespace

std::vector<int> part_periods(std::vector<int> teeth) {
    std::ranges::sort(teeth);
    teeth.erase(std::ranges::unique(teeth).begin(), teeth.end());
    return teeth;
}

std::vector<int> part_periods(const ToothErrors& errors) {
    std::vector<int> teeth;
    for (const GearErrors& gear : errors.gears) {
        teeth.push_back(gear.teeth);
    }
    return part_periods(std::move(teeth));
}

ToothErrors errors_of_part(ToothErrors errors, int teeth) {
    for (GearErrors& gear : errors.gears) {
        if (gear.teeth != teeth) {
            std::ranges::fill(gear.error_m, 0.0);
            std::ranges::fill(gear.slope_m, 0.0);
        }
    }
    return errors;
}

int part_meshes(std::span<const int> periods, int run_in_meshes) {
    int meshes = 1;
    for (const int period : periods) {
        meshes += period + run_in_meshes;
    }
    return meshes;
}

void SuperposedMotion::record(int k, MeshRecord& record) const {
    std::vector<const MeshRecord*> records;
    for (const SuperpositionPart& part : parts) {
        records.push_back(&part.records[index_in_period(k, part.records.size())]);
    }
    const auto superpose = [&](machine::AlignedVector MeshRecord::*what) {
        std::vector<const machine::AlignedVector*> all;
        for (const MeshRecord* part : records) {
            all.push_back(&(part->*what));
        }
        add_up(all, record.*what);
    };
    superpose(&MeshRecord::acceleration);
    superpose(&MeshRecord::te);
    if (!record.motion.empty()) {
        superpose(&MeshRecord::motion);
        superpose(&MeshRecord::mesh_force);
    }
}

void SuperposedMotion::state(int k, TileState& state) const {
    const auto superpose = [&](machine::AlignedVector TileState::*what) {
        std::vector<const machine::AlignedVector*> all;
        for (const SuperpositionPart& part : parts) {
            all.push_back(&(part.states[index_in_period(k, part.states.size())].*what));
        }
        add_up(all, state.*what);
    };
    superpose(&TileState::q);
    superpose(&TileState::v);
    superpose(&TileState::filter);
}

void SuperposedMotion::count_periodic_orbit_once() {
    for (std::size_t s = 1; s < parts.size(); ++s) {
        for (MeshRecord& record : parts[s].records) {
            subtract(periodic_orbit.acceleration, record.acceleration);
            subtract(periodic_orbit.te, record.te);
            if (!record.motion.empty()) {
                subtract(periodic_orbit.motion, record.motion);
                subtract(periodic_orbit.mesh_force, record.mesh_force);
            }
        }
        for (TileState& state : parts[s].states) {
            subtract(periodic_orbit_state.q, state.q);
            subtract(periodic_orbit_state.v, state.v);
            subtract(periodic_orbit_state.filter, state.filter);
        }
    }
}

std::vector<char> SuperposedMotion::keeps_contact(int from, int to, std::size_t lanes) const {
    std::vector<char> kept(lanes, 1);
    const std::size_t values = periodic_orbit_compression.size();
    const auto update_kept = [&](const auto& compression_at) {
        for (std::size_t i = 0; i < values; i += lanes) {
            for (std::size_t l = 0; l < lanes; ++l) {
                const double compression = compression_at(i + l);
                kept[l] = static_cast<char>(kept[l] & (compression > 0.0));
            }
        }
    };
    update_kept([&](std::size_t i) { return periodic_orbit_compression[i]; });
    for (const SuperpositionPart& part : parts) {
        for (const machine::AlignedVector& compression : part.compression) {
            update_kept(
                [&](std::size_t i) { return periodic_orbit_compression[i] + compression[i]; });
        }
    }
    machine::AlignedVector sum(values);
    for (int k = from; k < to; ++k) {
        sum = periodic_orbit_compression;
        for (const SuperpositionPart& part : parts) {
            const machine::AlignedVector& compression =
                part.compression[index_in_period(k, part.compression.size())];
            for (std::size_t i = 0; i < values; ++i) {
                sum[i] += compression[i];
            }
        }
        update_kept([&](std::size_t i) { return sum[i]; });
    }
    return kept;
}

}  // namespace gearpod::lockstep
