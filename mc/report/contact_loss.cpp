#include "mc/report/contact_loss.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "analysis/report/wording.hpp"

namespace gearpod::mc {
namespace {

// Quantile of sorted values, interpolated linearly.
double quantile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

}  // namespace

std::vector<ContactLossSummary> summarise_contact_loss(const Results& frame,
                                                       const RowSource& rows) {
    const RowShape shape = row_shape(frame);
    std::vector<std::vector<double>> values(shape.meshes);
    if (shape.meshes > 0) {
        for_each_row(rows, [&](const ResultRow& row) {
            const double* own = row.values + shape.contact_loss();
            for (std::size_t m = 0; m < shape.meshes; ++m) {
                if (std::isfinite(own[m])) {
                    values[m].push_back(own[m]);
                }
            }
        });
    }
    std::vector<ContactLossSummary> meshes;
    for (std::size_t m = 0; m < shape.meshes; ++m) {
        std::vector<double>& own = values[m];
        if (own.empty()) {
            continue;
        }
        std::ranges::sort(own);
        const double sum = std::accumulate(own.begin(), own.end(), 0.0);
        meshes.push_back({frame.contact_loss[m].name, sum / static_cast<double>(own.size()),
                          quantile(own, 0.05), quantile(own, 0.5), quantile(own, 0.95),
                          own.size()});
    }
    return meshes;
}

std::string contact_loss_text(const std::vector<ContactLossSummary>& meshes) {
    std::string text;
    for (const ContactLossSummary& mesh : meshes) {
        text += fmt::format("{}{} {:.2g} % ({:.2g} % to {:.2g} %)", text.empty() ? "" : ", ",
                            mesh.mesh, 100.0 * mesh.mean, 100.0 * mesh.lower, 100.0 * mesh.upper);
    }
    return text;
}

analysis::Section contact_section(const std::vector<ContactLossSummary>& meshes) {
    using analysis::percent_text;
    analysis::Section section{"contact", "Contact of the teeth", {}};
    analysis::Table table{"contact_loss",
                          "Share of time out of contact",
                          {"mesh", "mean", "5 % of gearboxes below", "median",
                           "95 % of gearboxes below", "gearboxes"},
                          {}};
    for (const ContactLossSummary& mesh : meshes) {
        table.rows.push_back({mesh.mesh, percent_text(mesh.mean), percent_text(mesh.lower),
                              percent_text(mesh.median), percent_text(mesh.upper),
                              fmt::format("{}", mesh.rows)});
    }
    section.state("contact.how",
                  meshes.empty()
                      ? ""
                      : "Share of its engagement, within the nominal path of contact, in "
                        "which a tooth pair carries no load (contact loss ratio), "
                        "averaged over the tooth pairs of a mesh.");
    section.add(std::move(table));
    return section;
}

}  // namespace gearpod::mc
