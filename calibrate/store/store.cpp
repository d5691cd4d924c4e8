#include "calibrate/store/store.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <unordered_map>

#include "calibrate/base/text.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/store/database.h"
#include "calibrate/store/outcome_json.h"

namespace pastefit {

namespace {

constexpr int kSchemaVersion = 4;
constexpr int kApplicationId = 0x70666974;  // "pfit": identifies a store among SQLite files

std::string numbers_text(const std::vector<double>& numbers) {
  auto json = nlohmann::ordered_json::array();
  for (const double number : numbers) json.push_back(number_to_json(number));
  return json.dump();
}

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (const auto& number : nlohmann::json::parse(text)) numbers.push_back(number_from_json(number));
  return numbers;
}

/// Checksum of all columns but the last, which is the checksum. A row is text, whatever type SQLite assigns.
std::string checksum_of(const Row& row) {
  std::string content;
  for (std::size_t i = 0; i + 1 < row.size(); ++i) content += std::to_string(row[i].size()) + ":" + row[i];
  return content_hash(content);
}

Row with_checksum(Row row) {
  row.emplace_back();
  row.back() = checksum_of(row);
  return row;
}

bool agrees(const Row& row) {
  return row.back() == checksum_of(row);
}

void add_inputs(Database& database, int epoch, const std::string& inputs) {
  database.run("INSERT INTO inputs VALUES (?, ?, ?)", with_checksum({std::to_string(epoch), inputs}));
}

void create(Database& database, const StoreIdentity& identity) {
  database.transact([&] {
    database.run("CREATE TABLE identity (name TEXT PRIMARY KEY, value TEXT NOT NULL)");
    database.run(
        "CREATE TABLE evaluations (sequence INTEGER PRIMARY KEY, key TEXT NOT NULL, epoch INTEGER NOT NULL,"
        " point TEXT NOT NULL, parameter_values TEXT NOT NULL, packing TEXT NOT NULL, observables TEXT NOT NULL,"
        " failure TEXT NOT NULL, run TEXT NOT NULL, checksum TEXT NOT NULL)");
    database.run("CREATE TABLE set_aside AS SELECT * FROM evaluations");
    database.run("CREATE TABLE inputs (epoch INTEGER PRIMARY KEY, content TEXT NOT NULL, checksum TEXT NOT NULL)");
    database.run("INSERT INTO identity VALUES ('program', ?)", {identity.program});
    database.run("INSERT INTO identity VALUES ('evaluations', '0')");
    add_inputs(database, 1, identity.inputs);
    database.run("PRAGMA application_id = " + std::to_string(kApplicationId));
    database.run("PRAGMA user_version = " + std::to_string(kSchemaVersion));
  });
}

const std::string kStartAnew = "choose another output folder, or start anew with --force";

/// True if there are only the tables of a store: a view or trigger in their place could run foreign code.
bool has_own_schema(Database& database) {
  std::vector<std::string> tables;
  for (const Row& row : database.run("SELECT type, name FROM sqlite_master ORDER BY name")) {
    if (row.at(0) == "table")
      tables.push_back(row.at(1));
    else if (row.at(0) != "index" || !row.at(1).starts_with("sqlite_autoindex_"))
      return false;
  }
  return tables == std::vector<std::string>{"evaluations", "identity", "inputs", "set_aside"};
}

/// Errors if a non-empty database is not a store.
Faults defects(Database& database, const std::string& file) {
  if (database.number("PRAGMA application_id") != kApplicationId)
    return {{file, "is a database, but not a store of evaluations", "choose another output folder"}};
  if (const int version = database.number("PRAGMA user_version"); version != kSchemaVersion)
    return {{file,
             "has schema version " + std::to_string(version) + ", this program reads version " +
                 std::to_string(kSchemaVersion),
             "resume with the program that wrote it; or " + kStartAnew}};
  if (!has_own_schema(database))
    return {
        {file, "holds other tables or views than a store of evaluations", "restore it from a copy; or " + kStartAnew}};
  if (const auto verdict = database.run("PRAGMA quick_check(1)").at(0).at(0); verdict != "ok")
    return {{file, "is damaged: " + verdict, "restore it from a copy; or " + kStartAnew}};
  return {};
}

std::string text_of_run(const StoredEvaluation& evaluation) {
  auto run = to_json(evaluation.run, evaluation.wall_s);
  if (evaluation.core_s > 0) run["core_s"] = number_to_json(evaluation.core_s);
  if (!evaluation.sketch.points.empty()) run["sketch"] = to_json(evaluation.sketch);
  return run.dump();
}

std::string program_of(Database& database) {
  const auto rows = database.run("SELECT value FROM identity WHERE name = 'program'");
  return rows.empty() ? "" : rows[0][0];
}

/// Errors if a non-empty database is not a store of this program.
Faults differences(Database& database, const std::string& file, const StoreIdentity& identity) {
  if (auto faults = defects(database, file); !faults.empty()) return faults;
  const std::string theirs = program_of(database);
  if (theirs == identity.program) return {};
  return {{file + ": program",
           "evaluations belong to '" + one_line(theirs) + "', not to '" + one_line(identity.program) + "'",
           "resume with the program that wrote it; or " + kStartAnew}};
}

/// Path of a change: "/study/search/seed" -> "study.search.seed"; changes of list items give the list.
std::string place_of(const std::string& pointer) {
  std::string out;
  for (std::size_t from = 1; from <= pointer.size();) {
    const auto to = std::min(pointer.find('/', from), pointer.size());
    const auto part = pointer.substr(from, to - from);
    const bool in_list = part == "-" || (!part.empty() && part.find_first_not_of("0123456789") == std::string::npos);
    out += in_list ? (to < pointer.size() ? "[" + part + "]" : "") : (out.empty() ? "" : ".") + part;
    from = to + 1;
  }
  return out;
}

std::vector<std::string> changes_of(const std::string& before, const std::string& now) {
  const auto parsed = [](const std::string& text) { return nlohmann::json::parse(text, nullptr, false); };
  const auto old = parsed(before), young = parsed(now);
  if (old.is_discarded() || young.is_discarded()) return {"everything"};
  std::vector<std::string> places;
  for (const auto& step : nlohmann::json::diff(old, young)) {
    auto place = place_of(step.at("path").get<std::string>());
    if (std::ranges::find(places, place) == places.end()) places.push_back(std::move(place));
  }
  return places;
}

/// Throws unless a row has `count` columns, e.g. for a table of another schema.
void demand_columns(const Row& row, std::size_t count) {
  if (row.size() != count)
    throw std::runtime_error("a table has " + std::to_string(row.size()) + " columns where " + std::to_string(count) +
                             " belong");
}

/// Throws std::invalid_argument for values that no simulation can have stored.
void refuse_what_nothing_stored(const StoredEvaluation& evaluation) {
  const auto outside = [](double value, double bound) { return !std::isnan(value) && std::abs(value) > bound; };
  for (const Reading& one : evaluation.readings.all())
    if (outside(one.value, kLargestReading)) throw std::invalid_argument(one.name + " is not a reading");
  for (const double coordinate : evaluation.point)
    if (!(coordinate >= 0 && coordinate <= 1)) throw std::invalid_argument("the point is outside of the bounds");
  for (const double value : evaluation.values)
    if (!std::isfinite(value)) throw std::invalid_argument("a parameter is not finite");
}

StoredEvaluation evaluation_of(const Row& row) {
  StoredEvaluation out;
  out.key = row.at(1);
  out.epoch = whole_number_of<int>(row[2]);
  out.point = numbers_of(row.at(3));
  out.values = parameters_from_json(nlohmann::json::parse(row.at(4)));
  out.packing = whole_number_of<std::uint64_t>(row[5]);
  out.readings = readings_from_json(nlohmann::ordered_json::parse(row.at(6)));
  out.failure = failure_from_json(nlohmann::json::parse(row.at(7)));
  const auto run = nlohmann::json::parse(row.at(8));
  out.run = run_from_json(run);
  if (const auto sketch = run.find("sketch"); sketch != run.end()) out.sketch = sketch_from_json(*sketch);
  out.wall_s = number_from_json(run.at("wall_s"));
  if (const auto core = run.find("core_s"); core != run.end()) out.core_s = number_from_json(*core);
  refuse_what_nothing_stored(out);
  return out;
}

}  // namespace

std::string evaluation_key(std::string_view program, const Test& test) {
  const nlohmann::json key{program, identity_of(test)};
  return content_hash(key.dump());
}

/// All evaluations are also held in memory: a search looks up known points often, and damaged rows are found on opening
/// instead of during a run. A record is about 2 kB.
struct Store::State {
  State(const std::filesystem::path& path, StoreIdentity who, DatabaseUse use)
      : file(path.string()), identity(std::move(who)), database(path, use) {}

  std::string file;
  StoreIdentity identity;
  Database database;
  int epoch = 1;
  bool begun = true;                 // the row of the epoch is written
  long long sequence = 0;            // of the last evaluation
  int written = 0;                   // evaluations since the store was made
  std::vector<std::string> damaged;  // sequences of rows with a wrong checksum
  std::vector<std::string> changes, remarks;
  mutable std::mutex mutex;
  std::vector<StoredEvaluation> evaluations;
  std::unordered_map<std::string, std::size_t> index;

  /// Loads all intact rows; returns the last inputs.
  std::string load() {
    for (const auto& row : database.run("SELECT * FROM evaluations ORDER BY sequence")) {
      demand_columns(row, 10);
      if (!agrees(row)) {
        damaged.push_back(row[0]);
        continue;
      }
      StoredEvaluation evaluation;
      try {
        evaluation = evaluation_of(row);
        sequence = whole_number_of<long long>(row[0]);
      } catch (const std::exception&) {  // intact, but not written by a simulation
        damaged.push_back(row.at(0));
        continue;
      }
      index.emplace(evaluation.key, evaluations.size());
      evaluations.push_back(std::move(evaluation));
    }
    const int known =
        static_cast<int>(evaluations.size() + damaged.size()) + database.number("SELECT count(*) FROM set_aside");
    const auto added = database.run("SELECT value FROM identity WHERE name = 'evaluations'");
    if (added.empty()) throw std::runtime_error("its number of evaluations is missing");
    written = whole_number_of<int>(added[0][0]);
    if (known != written)
      remarks.push_back("of " + std::to_string(written) + " evaluations that were written, " + std::to_string(known) +
                        " are there");
    if (!damaged.empty())
      remarks.push_back("damaged and set aside, to be simulated again if asked for: evaluation " + listed(damaged));
    const auto inputs = database.run("SELECT * FROM inputs ORDER BY epoch DESC LIMIT 1");
    if (!inputs.empty()) demand_columns(inputs[0], 3);
    if (inputs.empty() || !agrees(inputs[0])) throw std::runtime_error("its record of the study is missing or damaged");
    epoch = whole_number_of<int>(inputs[0][0]);
    return inputs[0].at(1);
  }

  /// Moves damaged rows away, so that their simulations can be repeated.
  void set_damaged_aside() {
    if (damaged.empty()) return;
    database.transact([&] {
      for (const auto& one : damaged) {
        database.run("INSERT INTO set_aside SELECT * FROM evaluations WHERE sequence = ?", {one});
        database.run("DELETE FROM evaluations WHERE sequence = ?", {one});
      }
    });
  }
};

Result<Store> Store::open(const std::filesystem::path& file, const StoreIdentity& identity) {
  try {
    const bool was_there = std::filesystem::exists(file);
    auto state = std::make_shared<State>(file, identity, DatabaseUse::write);
    auto& database = state->database;
    const bool fresh =
        database.number("SELECT count(*) FROM sqlite_master") == 0 && database.number("PRAGMA user_version") == 0;
    if (auto faults = fresh ? Faults{} : differences(database, file.string(), identity); !faults.empty()) return faults;
    // Only after the checks: changing the journal mode writes to the file's header.
    database.run("PRAGMA journal_mode = WAL");
    database.run("PRAGMA synchronous = FULL");
    if (fresh) create(database, identity);
    if (fresh && was_there) state->remarks.push_back("was empty: the search starts from the beginning");
    if (const std::string before = state->load(); before != identity.inputs) {
      state->changes = changes_of(before, identity.inputs);
      ++state->epoch;
      state->begun = false;
    }
    state->set_damaged_aside();
    return Store(std::move(state));
  } catch (const std::exception& error) {
    return Fault{file.string(), std::string("cannot be used as the store of evaluations: ") + error.what(),
                 "a writable place, free of other files of that name; or " + kStartAnew};
  }
}

Result<Store> Store::read(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file))
    return Fault{file.string(), "there is no such file", "the folder of a calibration"};
  try {
    auto state = std::make_shared<State>(file, StoreIdentity{}, DatabaseUse::read);
    if (auto faults = defects(state->database, file.string()); !faults.empty()) return faults;
    state->identity = {program_of(state->database), state->load()};
    return Store(std::move(state));
  } catch (const std::exception& error) {
    return Fault{file.string(), std::string("cannot be read as a store of evaluations: ") + error.what(),
                 "the store of a calibration"};
  }
}

const StoreIdentity& Store::identity() const {
  return state_->identity;
}

int Store::epoch() const {
  return state_->epoch;
}

const std::vector<std::string>& Store::changes() const {
  return state_->changes;
}

const std::vector<std::string>& Store::remarks() const {
  return state_->remarks;
}

std::optional<StoredEvaluation> Store::find(std::string_view key) const {
  const std::lock_guard lock(state_->mutex);
  const auto found = state_->index.find(std::string(key));
  if (found == state_->index.end()) return std::nullopt;
  return state_->evaluations[found->second];
}

Faults Store::add(const StoredEvaluation& evaluation) {
  const std::lock_guard lock(state_->mutex);
  if (state_->index.contains(evaluation.key)) return {};
  try {
    Database& database = state_->database;
    database.transact([&] {
      database.run("INSERT INTO evaluations VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                   with_checksum({std::to_string(state_->sequence + 1), evaluation.key, std::to_string(state_->epoch),
                                  numbers_text(evaluation.point), parameters_to_json(evaluation.values).dump(),
                                  std::to_string(evaluation.packing), to_json(evaluation.readings).dump(),
                                  to_json(evaluation.failure).dump(), text_of_run(evaluation)}));
      database.run("UPDATE identity SET value = ? WHERE name = 'evaluations'", {std::to_string(state_->written + 1)});
      if (!state_->begun) add_inputs(database, state_->epoch, state_->identity.inputs);
      // SQLite continues to write to a deleted file.
      if (!std::filesystem::exists(state_->file)) throw std::runtime_error("the file is gone");
    });
    state_->begun = true;
    ++state_->sequence;
    ++state_->written;
  } catch (const std::exception& error) {
    return {{state_->file, std::string("the evaluation could not be stored: ") + error.what(),
             "a folder that stays, on a disk with free space; go on with --resume"}};
  }
  state_->index.emplace(evaluation.key, state_->evaluations.size());
  state_->evaluations.push_back(evaluation);
  state_->evaluations.back().epoch = state_->epoch;
  return {};
}

std::vector<StoredEvaluation> Store::all() const {
  const std::lock_guard lock(state_->mutex);
  return state_->evaluations;
}

std::size_t Store::size() const {
  const std::lock_guard lock(state_->mutex);
  return state_->evaluations.size();
}

}  // namespace pastefit
