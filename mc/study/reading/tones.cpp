#include "mc/study/reading/tones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mc/input/spelling.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kExample = "write { frequency_Hz = 50, amplitude_m_s2 = 0.1 }";
const std::vector<std::string_view> kNames{"frequency_Hz", "amplitude_m_s2"};

class ToneReader {
  public:
    ToneReader(const Value& table, std::string which, const RejectTone& reject)
        : table_(table), which_(std::move(which)), reject_(reject) {}

    Tone read() const {
        if (table_.kind != Value::Kind::table) {
            reject_(fmt::format("{} must be a table, but is {}", which_, table_.kind_name()),
                    kExample);
            return {};
        }
        const bool spelled = reject_unknown();
        return {number(kNames[0], spelled), number(kNames[1], spelled)};
    }

  private:
    bool reject_unknown() const {
        bool spelled = true;
        for (const Entry& entry : table_.entries) {
            if (std::find(kNames.begin(), kNames.end(), entry.name) == kNames.end()) {
                spelled = false;
                reject_(fmt::format("{}: unknown key {}", which_, entry.name),
                        suggest(entry.name, kNames));
            }
        }
        return spelled;
    }

    // A misspelt key is not reported as missing as well.
    double number(std::string_view name, bool spelled) const {
        const Entry* entry = table_.find(name);
        if (entry == nullptr) {
            if (spelled) {
                reject_(fmt::format("{} has no {}", which_, name), kExample);
            }
            return 0.0;
        }
        const Value& value = entry->value;
        if (value.kind != Value::Kind::number && value.kind != Value::Kind::integer) {
            reject_(
                fmt::format("{}: {} must be a number, but is {}", which_, name, value.kind_name()),
                "");
        } else if (!std::isfinite(value.number) || value.number <= 0.0) {
            reject_(
                fmt::format("{}: {} must be > 0 and finite, but is {}", which_, name, value.number),
                "");
        }
        return value.number;
    }

    const Value& table_;
    std::string which_;
    const RejectTone& reject_;
};

}  // namespace

std::vector<Tone> read_tones(const Value& list, const RejectTone& reject) {
    std::vector<Tone> tones;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        tones.push_back(ToneReader(list.elements[i], fmt::format("tone {}", i + 1), reject).read());
    }
    return tones;
}

}  // namespace gearpod::mc
