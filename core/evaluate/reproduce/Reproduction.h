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

/// One number of a publication beside ours.
struct ReproducedCell {
    std::string row;
    std::string column;
    std::optional<double> paper;     ///< as printed; nothing where the publication leaves the cell empty
    double paperError = 0.0;         ///< standard error of the paper's figure, where it can be told
    std::optional<double> reference; ///< from an independent program or a closed form: what ours is judged by
    double tolerance = 0.0;          ///< largest |ours - reference|
    double ours = 0.0;
    Interval interval; ///< 95 %, of ours; empty (low = high) for exact values

    int judgedTogether = 1; ///< cells of the same table or figure
    int runs = 0;           ///< whose scatter the interval is made of: their number counts where they are few; 0: many

    bool isJudged() const { return reference.has_value(); }
    /// The interval that holds for all cells judged together, in twenty seeds: it leaves out the reference of one of
    /// them by chance once in twenty times (Bonferroni; Student's law where a scatter of few runs makes it).
    Interval jointInterval() const;
    /// Ours is as near to the reference as the tolerance says, or the joint interval holds the reference.
    bool isInside() const;
    /// ours - paper, in standard errors of the difference; nothing without a paper's figure or where neither error is
    /// known.
    std::optional<double> z() const;
};

/// A table or figure of a publication, made again.
struct Reproduction {
    std::string name;     ///< "billon:table1"
    std::string title;    ///< what it shows, with the source
    std::string quantity; ///< what the cells hold: "Pd", "ASN (stages)"
    std::vector<ReproducedCell> cells;
    std::vector<Chart> charts;
    std::vector<std::string> notes; ///< known misfits, conventions, what the reader should know

    bool isInside() const; ///< every judged cell is
};

struct ReproduceOptions {
    bool quick = false; ///< about a tenth of the trials
    std::uint64_t seed = 1;
};

/// A table or figure that can be made.
struct Reproducible {
    std::string name;
    std::string title;
    std::function<Reproduction(const ReproduceOptions &, const RunContext &)> run;
};

/// Tells every cell how many are judged together.
void judgeTogether(Reproduction &reproduction);

} // namespace faintline
