// Tooth pairs of a spur gear pair on their nominal paths, healthy or with a fault.
#pragma once

#include <vector>

#include "stiffness/mesh_stiffness.hpp"
#include "stiffness/path_extension.hpp"

namespace gearpod::stiffness {

class HealthyPairs final : public NominalPairs {
  public:
    explicit HealthyPairs(const MeshStiffness& spur) : spur_(spur) {}
    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override {
        spur_.total(tau, inside, stiffness);
    }
    void pair(int tooth, std::span<const double> tau, double inside,
              std::span<double> stiffness) const override {
        std::vector<double> own(tau.begin(), tau.end());
        for (double& at : own)
            at -= tooth;
        spur_.slice_stiffness(0, own, inside - tooth, stiffness);
    }

  private:
    const MeshStiffness& spur_;
};

class FaultyPairs final : public NominalPairs {
  public:
    FaultyPairs(const MeshStiffness& spur, const FaultyMesh& faulty)
        : healthy_(spur), faulty_(faulty) {}
    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override {
        if (passes(inside))
            faulty_.total(tau, inside, stiffness);
        else
            healthy_.total(tau, inside, stiffness);
    }
    void pair(int tooth, std::span<const double> tau, double inside,
              std::span<double> stiffness) const override {
        if (passes(inside))
            faulty_.tooth_pair(tooth, tau, inside, stiffness);
        else
            healthy_.pair(tooth, tau, inside, stiffness);
    }

  private:
    bool passes(double inside) const { return inside > 0 && inside < faulty_.duration(); }

    const HealthyPairs healthy_;
    const FaultyMesh& faulty_;
};

}  // namespace gearpod::stiffness
