#pragma once

#include "base/time.h"
#include "report/course.h"
#include "spec/robots.h"
#include "vm/common/observer.h"
#include "vm/matrix.h"

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace orb::report {

/// Values over time in bounded memory. Always keeps the first and the newest; beyond `capacity`
/// thins what lies between in ever coarser steps.
template <class Value>
class Series {
public:
  struct Entry {
    Duration t{};
    Value value{};
  };

  explicit Series(std::size_t capacity) : capacity_(capacity) {}

  void push(Duration t, Value value) {
    insert(entries_, {t, value});
    if (entries_.size() < capacity_)
      return;
    const auto span = entries_.back().t - entries_.front().t;
    quantum_ = std::max(2 * quantum_, 4 * span / static_cast<std::int64_t>(capacity_));
    std::vector<Entry> thinner;
    for (const auto& entry : entries_)
      insert(thinner, entry);
    entries_ = std::move(thinner);
  }

  const std::vector<Entry>& entries() const { return entries_; }
  bool empty() const { return entries_.empty(); }
  /// The least distance between entries; 0 if none was dropped.
  Duration quantum() const { return quantum_; }

private:
  void insert(std::vector<Entry>& into, const Entry& entry) const {
    const auto size = into.size();
    if (size >= 2 && into[size - 1].t - into[size - 2].t < quantum_)
      into[size - 1] = entry;
    else
      into.push_back(entry);
  }

  std::size_t capacity_;
  Duration quantum_{};
  std::vector<Entry> entries_;
};

/// A place in the files of a run; line 0: none.
struct Place {
  int file = 0;
  int line = 0;

  friend auto operator<=>(const Place&, const Place&) = default;
};

/// How an error names its place: by the robot's line, or by file and line if the source has no
/// numbers.
enum class ErrorPlace : std::uint8_t { RobotLine, Source };

/// Readings of the body's sensors at one moment, in the units of orbBasic.
struct Sensors {
  static constexpr std::size_t count = 11;
  /// Pitch, roll in deg; acceleration x, y, z and total in milli-g; rotation x, y, z in 0.1 deg/s;
  /// battery in 1/100 V; stabilisation 0 or 1.
  std::array<std::int32_t, count> values{};
};

/// An entry in the list of events.
struct Happening {
  enum class Kind : std::uint8_t { Print, Error, Marker, Bump, Collision, Macro, Sleep };
  static constexpr std::size_t kind_count = 7;

  Duration t{};
  Kind kind = Kind::Print;
  std::string text;
  std::string label; ///< a few characters to show on the path
  std::optional<vm::Pose> at;
};

/// Returns the kind's name on the page and in `events` of other languages: `print`, `bump`, …
std::string_view to_string(Happening::Kind kind);

/// The record of one run, built from its events: enough for report and drawing. Totals and counts
/// are exact; columns of long runs are thinned. Large because each kind of event has an overload
/// and each quantity that a report shows has a column.
class Journey {
public:
  struct File {
    std::string name;
    std::string text;
    std::vector<int> failed; ///< lines with faults
  };
  struct Count {
    std::uint64_t times = 0;
    Duration first{};
  };
  struct Totals {
    std::uint64_t lines = 0;
    std::uint64_t commands = 0; ///< of macros
    double distance_cm = 0;
    double top_speed_cm_s = 0;
    std::array<std::uint64_t, Happening::kind_count> happenings{};
  };
  /// A program variable by its source name; 0 until its first change.
  struct Variable {
    std::string name;
    std::string owner;           ///< the sub it belongs to; empty: global
    Series<std::int32_t> values; ///< at the lines that changed it
  };
  struct End {
    Duration t{};
    std::string reason; ///< as in the trace
    std::string words;  ///< a sentence for people
    std::string fault;  ///< the error that ended the run; empty: none. Set by the journey
  };

  Journey();

  // Before the run.
  int add_file(std::string name, std::string text);
  void map_line(int robot_line, Place place);
  void set_error_place(ErrorPlace place) { error_place_ = place; }
  void map_command(int macro, int command, Place place);
  /// Sets all variables: names and owners. They share the capacity of a report.
  void set_variables(const std::vector<std::pair<std::string, std::string>>& names);
  void add_wall(const vm::Wall& wall) { walls_.push_back(wall); }
  /// Sets the course. Its walls precede those added before.
  void set_course(Course course);

  /// Sets the robot, which determines whether the page shows a matrix.
  void set_robot(spec::Robot robot) { robot_ = robot; }

  // During the run. `t` counts from the start of the program.
  void add(Duration t, const vm::Event& event);
  /// Records that the line just ended left `value` in the variable of that index.
  void note(Duration t, std::size_t variable, std::int32_t value);
  /// Adds a cause to the latest error; empty if unknown.
  void explain(const std::string& why);
  /// Reads the sensors, at most every 20 ms.
  void sample(Duration t, const vm::Body& body);
  void finish(Duration t, std::string reason, std::string words);

  const std::vector<File>& files() const { return files_; }
  const std::map<Place, Count>& counts() const { return counts_; }
  const Totals& totals() const { return totals_; }
  const End& end() const { return end_; }
  const std::vector<vm::Wall>& walls() const { return walls_; }
  const std::optional<Course>& course() const { return course_; }
  const Series<vm::Pose>& poses() const { return poses_; }
  const Series<vm::Color>& led() const { return led_; }
  const Series<int>& back_led() const { return back_led_; }
  spec::Robot robot() const { return robot_; }
  /// Pictures of the matrix, besides the colours of led(): the newer of the two shows.
  const Series<vm::Matrix::Pixels>& pictures() const { return pictures_; }
  const Series<Place>& places() const { return places_; }
  const std::vector<Variable>& variables() const { return variables_; }
  const Series<Sensors>& sensors() const { return sensors_; }

  /// The list of events; if some were dropped, `left_out` are missing before index `gap_at`.
  struct Listed {
    std::vector<Happening> happenings;
    std::size_t gap_at = 0;
    std::uint64_t left_out = 0;
  };
  Listed listed() const;
  /// Returns true if any column was thinned.
  bool thinned() const;

private:
  void see(Duration t, const vm::event::Print& seen);
  void see(Duration t, const vm::event::Error& seen);
  void see(Duration t, const vm::event::Led& seen);
  void see(Duration t, const vm::event::BackLed& seen);
  void see(Duration t, const vm::event::Matrix& seen);
  void see(Duration, const vm::event::Drive&) {} // its effects show in the poses
  void see(Duration t, const vm::event::Position& seen);
  void see(Duration t, const vm::event::Marker& seen);
  void see(Duration t, const vm::event::Macro& seen);
  void see(Duration, const vm::event::MacroEnd&) {} // its last command shows it
  void see(Duration t, const vm::event::Line& seen);
  void see(Duration t, const vm::event::Collision& seen);
  void see(Duration t, const vm::event::Bump& seen);
  void see(Duration t, const vm::event::Sleep& seen);
  void see(Duration t, const vm::event::End& seen);
  void see(Duration t, const vm::event::StopLost& seen);

  void happen(Duration t, Happening::Kind kind, std::string text, std::string label = {});
  void visit(Duration t, Place place);
  void print(Duration t, std::string_view text);
  std::string where(int robot_line) const;

  std::vector<File> files_;
  std::vector<vm::Wall> walls_;
  std::optional<Course> course_;
  std::map<int, Place> lines_;
  ErrorPlace error_place_ = ErrorPlace::RobotLine;
  std::map<std::pair<int, int>, Place> commands_;
  std::map<Place, Count> counts_;
  Totals totals_;
  End end_;
  Series<vm::Pose> poses_;
  Series<vm::Color> led_;
  Series<int> back_led_;
  spec::Robot robot_ = spec::Robot::Sphero;
  Series<vm::Matrix::Pixels> pictures_;
  Series<Place> places_;
  std::vector<Variable> variables_;
  Series<Sensors> sensors_;
  std::vector<Happening> first_;
  std::deque<Happening> last_;
  std::optional<vm::Pose> pose_;
  std::string line_; ///< printed but not ended yet
};

/// A ball of a room and its journey, in places of the room.
struct RoomRun {
  std::string name;
  const Journey* journey = nullptr;
};

} // namespace orb::report
