#include "mc/options/number_options.hpp"

#include <utility>

namespace gearpod::mc {

CLI::Validator number_check(NumberForm form, NumberRange range) {
    const std::string bounds = range_text(range);
    return CLI::Validator([form, range = std::move(range)](
                              std::string& text) { return number_problem(text, form, range); },
                          bounds);
}

}  // namespace gearpod::mc
