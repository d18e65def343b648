#pragma once

#include "base/Interval.h"
#include "base/RunContext.h"
#include "evaluate/experiments/Chart.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// A published number and ours.
struct ReproducedCell {
    std::string row;
    std::string column;
    std::optional<double> paper;     ///< as printed; nothing if the publication leaves the cell empty
    double paperError = 0.0;         ///< standard error of the published number, if known
    std::optional<double> reference; ///< from an independent program or a closed form; the basis of the check
    double tolerance = 0.0;          ///< largest |ours - reference|
    double ours = 0.0;
    Interval interval; ///< 95 %, of ours; empty (low = high) for exact values

    int judgedTogether = 1; ///< cells of the same table or figure
    int runs = 0;           ///< number of runs on which the interval is based, relevant if few; 0: many

    bool isJudged() const { return reference.has_value(); }
    /// The interval for all cells judged together in twenty seeds: by chance it excludes the reference of one of them
    /// once in twenty times (Bonferroni; Student's law for a scatter from few runs).
    Interval jointInterval() const;
    /// Whether ours is within the tolerance of the reference, or the joint interval contains the reference.
    bool isInside() const;
    /// ours - paper, in standard errors of the difference; nothing without a published number or if neither error is
    /// known.
    std::optional<double> z() const;
};

/// A reproduced table or figure of a publication.
struct Reproduction {
    std::string name;     ///< "billon:table1"
    std::string title;    ///< subject and source
    std::string quantity; ///< quantity of the cells: "Pd", "ASN (stages)"
    std::vector<ReproducedCell> cells;
    std::vector<Chart> charts;
    std::vector<std::string> notes; ///< known deviations, conventions, remarks

    bool isInside() const; ///< whether all judged cells are
};

struct ReproduceOptions {
    bool quick = false; ///< about a tenth of the trials
    std::uint64_t seed = 1;
};

/// A table or figure that can be reproduced.
struct Reproducible {
    std::string name;
    std::string title;
    std::function<Reproduction(const ReproduceOptions &, const RunContext &)> run;
};

/// Sets the number of cells judged together in each cell.
void judgeTogether(Reproduction &reproduction);

} // namespace faintline
