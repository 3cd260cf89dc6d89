// A kind of fault as a study sees it, one file a kind: its names, its keys, what a tooth cannot
// hold, and the law of the stiffness library that it stands for. All of them: all_faults.hpp.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gears/mesh_geometry.hpp"
#include "mc/study/draft.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/keys/key.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"
#include "stiffness/teeth/tooth_fault.hpp"

namespace gearpod::mc {

// The key of [fault] that says how large a fault is: depth, stage, width or share. It alone may be
// random.
struct FaultSize {
    std::string_view name;  // "depth_mm"
    NumberAccess access;
    Unit unit;
    Range range;
    std::string_view doc;
};

// Any key of [fault] that a kind has. Kinds may share one.
struct FaultKey {
    std::string_view name;
    AnyAccess access;
    Unit unit;
    Range range;
    Need need;  // with the kind
    std::string_view fixed_because;
    std::string_view doc;
};

// Mesh in which the faulty tooth acts.
struct FaultyTooth {
    MeshMembers mesh;
    const std::optional<gears::MeshGeometry>& geometry;  // empty where the stiffness is given
    int gear;                                            // that has the tooth, 1 or 2 of the mesh
    const stiffness::FilletFoundation* foundation;       // that gear's, or null
    bool reversed;                                       // whether the mesh's first gear is driven
};

class FaultKind {
  public:
    virtual std::string_view name() const = 0;   // in study files, "spatial-crack"
    virtual std::string_view words() const = 0;  // in messages, "a spatial crack"
    // Where a study is described.
    virtual std::string_view title() const { return name(); }
    virtual const FaultSize& size() const = 0;
    virtual std::span<const FaultKey> other_keys() const = 0;
    // Whether it changes the tooth's sections or its contact, and not just the pair's stiffness.
    virtual bool shapes_tooth() const = 0;
    // Rejects what the faulty tooth cannot hold. The study's gears and face width are known then.
    virtual void check(StudyDraft& draft) const = 0;
    virtual std::unique_ptr<const stiffness::ToothFaultFamily> family(
        const Study& study, const FaultyTooth& tooth) const = 0;

    // Where the fault lies on the tooth and from where its sizes (SI) are measured, for the user.
    // The study must have the tooth geometry if the kind shapes the tooth.
    virtual std::string origin(const Study& study, std::span<const double> sizes) const = 0;

    // The size first.
    std::vector<FaultKey> keys() const;

  protected:
    ~FaultKind() = default;
};

}  // namespace gearpod::mc
