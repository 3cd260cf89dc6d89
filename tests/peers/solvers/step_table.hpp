// A step of the classical Runge-Kutta method, by gearpod and by Boost.odeint, on the same grid.
#pragma once

#include <functional>

#include "mc/accuracy_reference.hpp"
#include "own_march.hpp"

namespace gearpod::peers {

class StepTable {
  public:
    StepTable(OwnMarch& own, const mc::Reference& reference);

    void measure_errors();
    void round();
    void print() const;

  private:
    using Way = std::function<PeerRun(const Task&, const Extent&)>;
    void add(const std::string& name, Way way);

    OwnMarch& own_;
    const mc::Reference& reference_;
    std::vector<Row> rows_;
    std::vector<Way> ways_;  // of the rows but the first
};

}  // namespace gearpod::peers
