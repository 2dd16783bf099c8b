// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: errors that a user can cause and mend, each with the place it comes from, reported all at
// once. Method: UserError is one error (file, line, column, sentence). Checks that can go on after
// an error put it into an
//   ErrorCollector and end with throw_if_any(), which throws UserErrors with every error found,
//   ordered by place: a user mends a file in one pass. UserErrors is a UserError, so that one catch
//   clause serves both.
// Why not assertions or error codes: assertions are for our own mistakes; codes lose the sentence.
// Units: none. Failure: these are the failures. The library never prints; app/main.cpp writes
// `error: <what()>`.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace bondlab {

// Where in a user's file something stands. line and column count from 1; 0 means unknown. An empty
// file means that the error has no place in a file (a command-line option, say).
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

// "file:line:column", without the parts that are unknown.
std::string to_string(const Place &place);

class UserError : public std::runtime_error {
 public:
  explicit UserError(const std::string &text) : UserError(Place{}, text) {}
  UserError(const Place &place, const std::string &text);

  const Place &place() const { return place_; }
  const std::string &text() const { return text_; }  // the sentence without the place

 protected:
  struct Combined {};
  UserError(Combined, const std::string &what, const Place &place, const std::string &text)
      : std::runtime_error(what), place_(place), text_(text) {}

 private:
  Place place_;
  std::string text_;
};

// Several errors. what() has one line each. Never empty.
class UserErrors : public UserError {
 public:
  explicit UserErrors(std::vector<UserError> errors);
  const std::vector<UserError> &errors() const { return errors_; }

 private:
  std::vector<UserError> errors_;
};

class ErrorCollector {
 public:
  void add(const Place &place, const std::string &text) { errors_.emplace_back(place, text); }
  void add(const UserError &error);  // takes apart a UserErrors
  bool empty() const { return errors_.empty(); }
  const std::vector<UserError> &errors() const { return errors_; }
  void throw_if_any() const;  // UserErrors, ordered by file (first seen first), line and column

 private:
  std::vector<UserError> errors_;
};

// The member of `known` nearest to `given` in spelling, or "" when none is near: "sigmac" ->
// "sigma_c".
std::string nearest_word(const std::string &given, const std::vector<std::string> &known);

// "a, b, c"; for the list of allowed values at the end of a message.
std::string join(const std::vector<std::string> &words, const std::string &separator = ", ");

}  // namespace bondlab
