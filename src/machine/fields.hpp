// Field table of a struct: the names of all its members, listed once for JSON, files and messages.
#pragma once

#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

// Stands after the struct, in its namespace, and names all members in their order. The names are
// those in JSON and files, where they may differ from those of the members. A member that is not
// written there has a name that ends in "_"; messages between ranks have all members.
#define GEARPOD_FIELDS(TYPE, ...)                         \
    constexpr std::string_view field_names(const TYPE*) { \
        return #__VA_ARGS__;                              \
    }                                                     \
    inline auto fields_of(TYPE& structure) {              \
        auto& [__VA_ARGS__] = structure;                  \
        return std::tie(__VA_ARGS__);                     \
    }                                                     \
    inline auto fields_of(const TYPE& structure) {        \
        const auto& [__VA_ARGS__] = structure;            \
        return std::tie(__VA_ARGS__);                     \
    }

namespace gearpod {

template <class Structure>
concept HasFields = requires(Structure& structure) {
    fields_of(structure);
};

// Member of a struct at an index, and its name, at compile time.
template <class Structure, std::size_t position>
struct FieldName {
    static constexpr std::size_t index = position;
    static constexpr std::string_view name = [] {
        std::string_view names = field_names(static_cast<const Structure*>(nullptr));
        for (std::size_t i = 0; i < position; ++i) {
            names.remove_prefix(names.find(',') + 2);
        }
        return names.substr(0, names.find(','));
    }();
    static constexpr bool written = !name.ends_with('_');
};

// Calls use(field, member) for all members; `field` is a FieldName.
template <HasFields Structure, class Use>
void for_each_field(Structure& structure, const Use& use) {
    const auto members = fields_of(structure);
    [&]<std::size_t... index>(std::index_sequence<index...>) {
        (use(FieldName<std::remove_const_t<Structure>, index>{}, std::get<index>(members)), ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(members)>>{});
}

}  // namespace gearpod
