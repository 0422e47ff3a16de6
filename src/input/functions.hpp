// Functions of time and place in a case: constants, formulas, tables.
#pragma once

#include <optional>

#include "input/checker.hpp"

namespace gannet {

/// A function, or three as a vector; mistakes are noted and the value is then incomplete.
void check_function(const TextNode& node, const Key& key, Value& value, CheckContext& context);
void check_vector_function(const TextNode& node, const Key& key, Value& value,
                           CheckContext& context);

/// A table in time: [[time, value], ...], {table: [[time, value], ...]} or {csv: FILE, column:
/// NAME}, maps with an optional factor. `wanted`: dimension of the values; nullptr takes any, the
/// same in all. Nothing, and a mistake noted, where it is none.
std::optional<Curve> read_curve(const TextNode& node, const std::string& path,
                                const Dimension* wanted, CheckContext& context);

/// A CSV file as it stands: a header with a unit where one is given, "force z [kN]", SI where there
/// is none; lines that start with # above it are left out.
struct CsvTable {
  struct Column {
    std::string name;
    Quantity unit{1, dim::none, true};  ///< what 1 in the file is [SI]
  };
  std::string file;
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> cells;  ///< by line and column
  std::vector<int> lines;                       ///< of the file, one for each line of cells
};

/// Throws std::invalid_argument where a file cannot be read, a unit is none, or no line follows.
CsvTable read_csv_table(const std::string& file);

/// A column in SI. Throws std::invalid_argument that names the line of what is no number.
std::vector<double> numbers_of(const CsvTable& table, std::size_t column);

/// One column of a CSV file over its first, the time; headers "NAME [unit]" give units, SI where
/// there are none. Empty column: the only one. Throws std::invalid_argument that says what is wrong
/// and what columns there are.
Curve read_csv_curve(const std::string& file, const std::string& column);

/// The tables under `curves`. Fills context.formulas.
void check_curves(const TextNode& curves, CheckContext& context);

}  // namespace gannet
