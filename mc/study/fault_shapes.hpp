// Fault parameters of a study, by kind of fault. Each kind has a struct that only its own file
// knows.
#pragma once

#include <concepts>
#include <map>
#include <memory>
#include <typeindex>
#include <typeinfo>

namespace gearpod::mc {

// Base of a fault kind's parameter struct, which must be copyable, comparable and
// default-constructible.
struct FaultShape {
    bool operator==(const FaultShape&) const = default;
};

// Heterogeneous map from parameter type to value. Copies share the values until one of them edits
// it.
class FaultShapes {
  public:
    // Value as last edited, or a default-constructed one.
    template <std::derived_from<FaultShape> Shape>
    const Shape& get() const {
        static const Shape defaults{};
        const auto found = held_.find(typeid(Shape));
        return found == held_.end() ? defaults
                                    : static_cast<const Holder<Shape>&>(*found->second).shape;
    }
    // Reference for changing the value, valid until the next call of edit() for the same type.
    template <std::derived_from<FaultShape> Shape>
    Shape& edit() {
        auto own = std::make_shared<Holder<Shape>>(get<Shape>());
        Shape& shape = own->shape;
        held_[typeid(Shape)] = std::move(own);
        return shape;
    }
    bool operator==(const FaultShapes& other) const {
        return all_same_in(other) && other.all_same_in(*this);
    }

  private:
    struct Held {
        virtual ~Held() = default;
        virtual bool same_in(const FaultShapes& other) const = 0;
    };
    template <class Shape>
    struct Holder final : Held {
        explicit Holder(const Shape& from) : shape(from) {}
        bool same_in(const FaultShapes& other) const override {
            return shape == other.get<Shape>();
        }
        Shape shape;
    };

    bool all_same_in(const FaultShapes& other) const {
        for (const auto& [type, held] : held_) {
            if (!held->same_in(other)) {
                return false;
            }
        }
        return true;
    }

    std::map<std::type_index, std::shared_ptr<const Held>> held_;
};

}  // namespace gearpod::mc
