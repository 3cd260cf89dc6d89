#include "mc/scene/gearbox_streams.hpp"

#include <array>
#include <boost/random/uniform_01.hpp>
#include <ranges>
#include <string>

namespace gearpod::mc {
namespace {

// Near an alarm small exchanges are kept more often, large ones lead further.
constexpr std::array kShares{0.3, 0.1, 0.03};

Philox plain_stream(const Study& study, Group group, std::uint64_t index,
                    std::string_view purpose) {
    return {static_cast<std::uint64_t>(study.ensemble.seed), group, index, parameter_id(purpose)};
}

double share_of(const Study& study, Group group, std::uint64_t index) {
    return kShares[plain_stream(study, group, index, "exchange.share")() % kShares.size()];
}

// Which numbers for a purpose another gearbox gives.
Philox taken_stream(const Study& study, Group group, std::uint64_t index,
                    std::string_view purpose) {
    return plain_stream(study, group, index, std::string(purpose).append(".exchange"));
}

bool takes(double share, Philox& taken) {
    return boost::random::uniform_01<double>()(taken) < share;
}

}  // namespace

std::uint64_t drawn_from(const Study& study, const GearboxId& id, std::string_view purpose) {
    for (const std::uint64_t other : std::views::reverse(id.exchanged)) {
        Philox taken = taken_stream(study, id.group, other, purpose);
        if (takes(share_of(study, id.group, other), taken)) {
            return other;
        }
    }
    return id.index;
}

Philox gearbox_stream(const Study& study, const GearboxId& id, std::string_view purpose) {
    return plain_stream(study, id.group, drawn_from(study, id, purpose), purpose);
}

Philox record_stream(const Study& study, const GearboxId& id, std::string_view purpose) {
    return id.record == Record::judged
               ? gearbox_stream(study, id, purpose)
               : gearbox_stream(study, id, std::string(purpose).append(".baseline"));
}

Philox noise_stream(const Study& study, const GearboxId& id, std::string_view purpose) {
    return id.repeat == 0
               ? record_stream(study, id, purpose)
               : record_stream(study, id,
                               std::string(purpose) + ".repeat." + std::to_string(id.repeat));
}

Normals::Normals(const Study& study, const GearboxId& id, std::string_view purpose)
    : engine_(plain_stream(study, id.group, id.index, purpose)) {
    for (const std::uint64_t other : id.exchanged) {
        exchanges_.push_back({share_of(study, id.group, other),
                              taken_stream(study, id.group, other, purpose),
                              plain_stream(study, id.group, other, purpose)});
    }
}

double Normals::operator()() {
    double number = unit_(engine_);
    for (Exchange& exchange : exchanges_) {
        const double other = unit_(exchange.engine);
        if (takes(exchange.share, exchange.taken)) {
            number = other;
        }
    }
    return number;
}

}  // namespace gearpod::mc
