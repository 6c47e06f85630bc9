#include "testing/run_suite.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <vector>

namespace orb::testing {
namespace {

/// A case and where its result goes.
struct Task {
  const Group* group;
  CaseResult* result;
};

/// Keeps the details of each group's first failures, in whatever order cases finish.
class FirstFailures {
public:
  /// Records that a task is done; `number` counts over all tasks.
  void add(const std::vector<Task>& tasks, std::size_t number) {
    const auto& task = tasks[number];
    if (task.result->verdict == Verdict::Passed)
      return;
    const std::lock_guard lock(mutex_);
    auto& known = of_group_[task.group];
    known.insert(number);
    if (known.size() <= most_told)
      return;
    const auto last = std::prev(known.end());
    omit(*tasks[*last].result);
    known.erase(last);
  }

private:
  std::mutex mutex_;
  std::map<const Group*, std::set<std::size_t>> of_group_;
};

/// The groups in report order, with an empty result for each case that runs here.
std::vector<GroupResult> empty_results(const Suite& suite, const Shard& shard) {
  std::vector<GroupResult> groups;
  for (const auto& group : suite.groups) {
    const auto& test = suite.test_of(group);
    auto& made = groups.emplace_back();
    made.file = suite.files[group.file].source->name();
    made.test = test.name.text;
    made.line = test.line;
    made.points = test.points;
    made.program = suite.programs[group.program].name;
    made.first = group.first;
    made.count = group.seeds.count();
    for (std::uint64_t k = 0; k < made.count; ++k)
      if (shard.takes(group.first + k)) {
        made.cases.emplace_back();
        made.cases.back().seed = group.seeds.first + k;
      }
  }
  return groups;
}

} // namespace

Results run_suite(const Suite& suite, const RunOptions& options, Progress& progress) {
  Results results{suite.cases, {}, empty_results(suite, options.shard), {}};
  for (const auto& program : suite.programs)
    if (program.missing && std::find(results.missing.begin(), results.missing.end(),
                                     program.name) == results.missing.end())
      results.missing.push_back(program.name);
  if (options.shard.count > 1)
    results.shards.push_back(options.shard);
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < suite.groups.size(); ++i)
    for (auto& one : results.groups[i].cases)
      tasks.push_back({&suite.groups[i], &one});

  vm::NativePrograms native;
  FirstFailures failures;
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> done{0};
  // Runs the next task; false if none is left.
  const auto run_one = [&] {
    const auto index = next.fetch_add(1);
    if (index >= tasks.size())
      return false;
    const auto& task = tasks[index];
    const auto seed = task.result->seed;
    *task.result = options.judge ? options.judge(suite, *task.group, seed)
                                 : run_case(suite, *task.group, seed, &native, nullptr);
    failures.add(tasks, index);
    done.fetch_add(1);
    return true;
  };
  std::vector<std::thread> others;
  const auto wanted = std::min<std::size_t>(options.judge ? 1 : options.jobs, tasks.size());
  try {
    for (std::size_t i = 1; i < wanted; ++i)
      others.emplace_back([&] {
        while (run_one()) {
        }
      });
  } catch (const std::system_error&) {
    // The system refuses more threads: the ones already running do the work.
  }
  while (run_one())
    progress.on_cases(done, tasks.size());
  for (auto& other : others)
    other.join();
  progress.on_cases(tasks.size(), tasks.size());
  return results;
}

} // namespace orb::testing
