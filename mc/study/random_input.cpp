#include "mc/study/random_input.hpp"

namespace gearpod::mc {

std::optional<RecordQuantity> record_quantity(std::string_view key) {
    if (key == "operation.torque_N_m") {
        return RecordQuantity::torque;
    }
    if (key.starts_with("operation.") && key.ends_with("_speed_rpm")) {
        return RecordQuantity::speed;
    }
    if (key == "sensor.gain") {
        return RecordQuantity::gain;
    }
    if (key == "sensor.noise_m_s2") {
        return RecordQuantity::noise;
    }
    return std::nullopt;
}

}  // namespace gearpod::mc
