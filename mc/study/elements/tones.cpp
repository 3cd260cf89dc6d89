#include "mc/study/elements/tones.hpp"

#include <fmt/format.h>

#include "mc/study/gears.hpp"

namespace gearpod::mc {

std::vector<Tone> read_tones(const Value& list, const RejectElement& reject) {
    std::vector<Tone> tones;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        const ListElement element(list.elements[i], fmt::format("tone {}", i + 1), kToneFields,
                                  "write { frequency_Hz = 50, amplitude_m_s2 = 0.1 }", reject);
        Tone tone;
        if (element.has("shaft") || element.has("order")) {
            element.first_of("shaft", "frequency_Hz");
            tone.shaft = element.has("shaft") ? element.shaft() : std::nullopt;
            tone.order = element.number("order", kAbove0);
        } else {
            tone.frequency_Hz = element.number("frequency_Hz", kAbove0);
        }
        tone.amplitude_m_s2 = element.number("amplitude_m_s2", kAbove0);
        tones.push_back(tone);
    }
    return tones;
}

std::string tone_table(const Tone& tone) {
    return tone.shaft ? fmt::format("{{ shaft = \"{}\", order = {}, amplitude_m_s2 = {} }}",
                                    member_name(*tone.shaft), tone.order, tone.amplitude_m_s2)
                      : fmt::format("{{ frequency_Hz = {}, amplitude_m_s2 = {} }}",
                                    tone.frequency_Hz, tone.amplitude_m_s2);
}

}  // namespace gearpod::mc
