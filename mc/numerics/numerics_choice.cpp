#include "mc/numerics/numerics_choice.hpp"

#include <fmt/format.h>

namespace gearpod::mc {

std::string NumericsChoice::text() const {
    if (of_scatter && worst_feature.empty()) {
        return setting.text() + " (no fewer steps keep the tolerance)";
    }
    return fmt::format("{} (features within {:.2g}{} on {} pilot gearboxes; the worst is {})",
                       setting.text(), error, of_scatter ? " of their scatter" : "", gearboxes,
                       worst_feature);
}

}  // namespace gearpod::mc
