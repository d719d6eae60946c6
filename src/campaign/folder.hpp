// A campaign's folder: rig.yaml, scenario.yaml and options.json say what is thrown, throws.csv holds what was.
#pragma once

#include <string>
#include <vector>

#include "src/campaign/plan.hpp"
#include "src/campaign/row.hpp"
#include "src/output/output_folder.hpp"

namespace hogline::campaign {

/// Open for one program at a time. Rows stand in the order of their numbers, from 0 and without gaps; each is written
/// at once or, when the program is killed, not at all.
class Folder {
 public:
  /// Begins a campaign, or takes one up again: a row that was not finished is cut off. Throws ConfigError when the
  /// folder holds another plan, was filled by another `program`, or is in use; std::runtime_error when it can not be
  /// written.
  Folder(const std::string& path, const Plan& plan, const std::string& program);

  const std::vector<Row>& rows() const { return rows_; }
  /// Precondition: the next row. Throws std::runtime_error when the disk is full.
  void append(const Row& row);

 private:
  void open();
  void take_up(const Plan& plan, const std::string& program);
  void cut_unfinished();
  void write(const std::string& text);

  /// The table's descriptor.
  struct Table {
    Table() = default;
    ~Table();
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;
    int descriptor = -1;
  };

  std::string path_;
  OutputFolder lock_;
  std::vector<Row> rows_;
  Table table_;
};

/// The plan of a campaign that was begun. Throws ConfigError.
PlanText read_plan(const std::string& path);
/// Its whole rows. Throws ConfigError.
std::vector<Row> read_rows(const std::string& path);

}  // namespace hogline::campaign
