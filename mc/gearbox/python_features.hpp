// Computes the features of a study that are functions in Python.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "features/feature.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Exception in a feature, or a return value that is not a number. The feature has no value there.
struct PythonProblem {
    std::string feature;
    double noise_level = 1.0;
    std::string place;  // file and line
    std::string what;
};

// Use one object per thread.
class PythonFeatures {
  public:
    // Computes those of `features` that are external, in this order. The scene must outlive the
    // object.
    PythonFeatures(const Scene& scene, std::span<const features::Feature* const> features);

    bool empty() const { return used_.empty(); }

    // Adds the signals of a record at the next noise level.
    void add(double noise_level, const InstanceInputs& inputs, const features::FeatureInput& input);
    // Values [feature * levels + level] of the record whose signals were added, NaN where a feature
    // fails; the reasons are in problems(). `work` names the record in messages. Throws PythonError
    // and machine::Cancelled as PythonWorker::ask does.
    std::vector<double> compute(const std::string& work);
    const std::vector<PythonProblem>& problems() const { return problems_; }

  private:
    // Appends one record's signals; the first level also describes them in the request.
    void add_record(const char* kind, const InstanceInputs& inputs,
                    const features::FeatureInput& input);

    const Scene& scene_;
    std::vector<PythonFeature> used_;
    struct Request;
    std::shared_ptr<Request> request_;  // of the record whose signals are being added
    std::vector<double> values_;
    std::vector<PythonProblem> problems_;
};

// Prints each problem once per process and place, with the record that `work` names, on stderr.
void print_python_problems(const std::vector<PythonProblem>& problems, const std::string& work);

}  // namespace gearpod::mc
