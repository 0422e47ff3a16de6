// The two kinds of error that a user can meet, and where they came from in the user's text.
// Programmer's errors are asserts.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace gannet {

/// A place in a text file; line and column count from 1, 0 where unknown.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
  /// "case.yaml:14:5", without the numbers that are unknown.
  [[nodiscard]] std::string text() const;
};

/// Wrong input: one message a mistake, each complete with its place. Exit code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> messages);
  explicit InputError(const std::string& message);
  InputError(const Location& where, const std::string& what);
  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

/// What a run that went wrong tells its user: what, where, when, why, and what to try.
struct RunFailure {
  std::string what;
  std::string where;
  std::string why;
  std::string try_this;
};

/// A run that went wrong (NaN, energy error, step collapse, runaway). Exit code 3.
class RunError : public std::runtime_error {
 public:
  explicit RunError(RunFailure failure);
  [[nodiscard]] const RunFailure& failure() const { return failure_; }

 private:
  RunFailure failure_;
};

}  // namespace gannet
