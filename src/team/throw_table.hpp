// Throws of both robots as a table, a row each, and what all of them together come to.
#pragma once

#include <string>
#include <vector>

#include "src/team/truth_check.hpp"

namespace hogline {

/// Keys of throws.csv, with the line's end.
std::string throw_header();
/// `end` and `shot` from 0; end -1: practice before the first.
std::string throw_row(const TurnRecord& record, int end, int shot);

/// Seen less true, of the stones that lie in both.
double worst_place_m(const TurnRecord& record);

/// The figures in words: a Markdown table.
std::string figures_table(const TruthFigures& figures, const std::vector<TurnRecord>& records);

/// The same for programs: one JSON object.
std::string figures_json(const TruthFigures& figures, const std::vector<TurnRecord>& records);

/// How the foretold places of stones that met nothing came nearer to where they lay: a Markdown table by the number of
/// throws that the ice had been learnt from.
std::string ice_table(const std::vector<TurnRecord>& records);

}  // namespace hogline
