// HDF5 identifiers that close themselves, and HDF5 errors as exceptions instead of printed error
// stacks.
#pragma once

#include <hdf5.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace gearpod::mc {

// Failure of an HDF5 call; `what` names the attempted operation.
class Hdf5Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class Hdf5Handle {
  public:
    using Close = herr_t (*)(hid_t);

    // Takes the return value of an HDF5 call. Throws Hdf5Error if the call failed.
    Hdf5Handle(hid_t id, Close close, const std::string& attempted) : id_(id), close_(close) {
        if (id < 0) {
            throw Hdf5Error(attempted);
        }
    }
    Hdf5Handle(Hdf5Handle&& other) noexcept
        : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Hdf5Handle& operator=(Hdf5Handle&&) = delete;
    ~Hdf5Handle() {
        if (id_ >= 0) {
            close_(id_);
        }
    }

    hid_t get() const { return id_; }

    // Closes the identifier. Throws Hdf5Error if that fails.
    void close_now(const std::string& attempted) {
        if (close_(std::exchange(id_, -1)) < 0) {
            throw Hdf5Error(attempted);
        }
    }

  private:
    hid_t id_;
    Close close_;
};

// Throws Hdf5Error if the status of a call is a failure.
inline void check(herr_t status, const std::string& attempted) {
    if (status < 0) {
        throw Hdf5Error(attempted);
    }
}

// Suppresses HDF5's error messages during its lifetime; return values still report errors.
class SilentHdf5 {
  public:
    SilentHdf5() {
        H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    SilentHdf5(const SilentHdf5&) = delete;
    SilentHdf5& operator=(const SilentHdf5&) = delete;
    ~SilentHdf5() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

  private:
    H5E_auto2_t print_ = nullptr;
    void* data_ = nullptr;
};

}  // namespace gearpod::mc
