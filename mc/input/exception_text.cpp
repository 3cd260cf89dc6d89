#include "mc/input/exception_text.hpp"

#include <new>
#include <stdexcept>

namespace gearpod::mc {

std::string exception_text(const std::exception& error) {
    const bool no_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
                           dynamic_cast<const std::length_error*>(&error) != nullptr;
    return no_memory ? "out of memory; reduce numerics.threads, or the size of the study "
                       "(ensemble.instances, sensor.noise_levels, sensor.sampling_Hz)"
                     : error.what();
}

}  // namespace gearpod::mc
