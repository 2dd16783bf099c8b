// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: say whether a text is well-formed XML, and find elements in it; for tests only.
// Method: a small parser of its own (tags, attributes, the five entities and character references,
//   comments, DOCTYPE), so that the writer isn't checked by the code that wrote. Ids must be
//   unique.
// Units: none.
// Failure: `error` says what is wrong and near which text.
// Limits: no CDATA, no processing instructions.
#pragma once

#include <cctype>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace bondlab::xml {

struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  // of the element itself and all in it
  std::size_t depth = 0;
};

struct Document {
  std::string error;              // "" when well-formed
  std::vector<Element> elements;  // in the order of their start tags

  std::size_t count(const std::string &name) const {
    std::size_t n = 0;
    for (const Element &element : elements) n += element.name == name;
    return n;
  }
};

class Parser {
 public:
  explicit Parser(const std::string &text) : text_(text) {}

  Document parse() {
    while (at_ < text_.size() && document_.error.empty()) {
      if (text_[at_] != '<')
        characters();
      else if (starts("<!--"))
        skip_past("-->");
      else if (starts("<!DOCTYPE"))
        skip_past(">");
      else if (starts("</"))
        end_tag();
      else
        start_tag();
    }
    if (document_.error.empty() && !open_.empty())
      fail("<" + document_.elements[open_.back()].name + "> isn't closed");
    if (document_.error.empty() && document_.elements.empty()) fail("no element");
    return document_;
  }

 private:
  bool starts(const std::string &word) const { return text_.compare(at_, word.size(), word) == 0; }
  void fail(const std::string &what) {
    if (document_.error.empty())
      document_.error = what + " near: " + text_.substr(at_ < 40 ? 0 : at_ - 40, 90);
  }
  void skip_past(const std::string &word) {
    const std::size_t end = text_.find(word, at_);
    if (end == std::string::npos) return fail(word + " is missing");
    at_ = end + word.size();
  }
  std::string name() {
    const std::size_t from = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) ||
                                  std::string("-_:.").find(text_[at_]) != std::string::npos))
      ++at_;
    if (at_ == from) fail("a name is missing");
    return text_.substr(from, at_ - from);
  }
  void blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  char reference() {
    const std::map<std::string, char> known = {
        {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"#39", '\''}};
    const std::size_t end = text_.find(';', at_);
    const auto found =
        end == std::string::npos ? known.end() : known.find(text_.substr(at_ + 1, end - at_ - 1));
    if (found == known.end()) {
      fail("'&' isn't escaped");
      ++at_;
      return '&';
    }
    at_ = end + 1;
    return found->second;
  }
  void characters() {
    std::string words;
    while (at_ < text_.size() && text_[at_] != '<' && document_.error.empty()) {
      const unsigned char c = static_cast<unsigned char>(text_[at_]);
      if (c < 0x20 && c != '\n' && c != '\t') fail("a control character");
      if (starts("]]>")) fail("']]>' in a text");
      if (c == '&')
        words += reference();
      else
        words += text_[at_++];
    }
    for (const std::size_t element : open_) document_.elements[element].text += words;
    if (open_.empty() && words.find_first_not_of(" \n\t") != std::string::npos)
      fail("text outside the root");
  }
  void start_tag() {
    ++at_;
    Element element;
    element.name = name();
    element.depth = open_.size();
    for (blanks();
         at_ < text_.size() && text_[at_] != '>' && text_[at_] != '/' && document_.error.empty();
         blanks()) {
      const std::string key = name();
      blanks();
      if (at_ >= text_.size() || text_[at_] != '=') return fail("attribute without value");
      ++at_;
      blanks();
      const char quote = at_ < text_.size() ? text_[at_++] : ' ';
      if (quote != '"' && quote != '\'') return fail("attribute without quotes");
      std::string value;
      while (at_ < text_.size() && text_[at_] != quote && document_.error.empty()) {
        if (text_[at_] == '<') return fail("'<' in an attribute");
        if (text_[at_] == '&')
          value += reference();
        else
          value += text_[at_++];
      }
      ++at_;
      if (!element.attributes.emplace(key, value).second) fail("attribute " + key + " twice");
      if (key == "id" && !ids_.insert(value).second) fail("id " + value + " twice");
    }
    if (open_.empty() && !document_.elements.empty()) fail("a second root");
    const bool closed = at_ < text_.size() && text_[at_] == '/';
    at_ += closed;
    if (at_ >= text_.size() || text_[at_] != '>') return fail("'>' is missing");
    ++at_;
    document_.elements.push_back(element);
    if (!closed) open_.push_back(document_.elements.size() - 1);
  }
  void end_tag() {
    at_ += 2;
    const std::string ended = name();
    blanks();
    if (at_ >= text_.size() || text_[at_] != '>') return fail("'>' is missing");
    ++at_;
    if (open_.empty() || document_.elements[open_.back()].name != ended)
      return fail("</" + ended + "> doesn't close what is open");
    open_.pop_back();
  }

  const std::string &text_;
  std::size_t at_ = 0;
  Document document_;
  std::vector<std::size_t> open_;
  std::set<std::string> ids_;
};

inline Document parse(const std::string &text) { return Parser(text).parse(); }

}  // namespace bondlab::xml
