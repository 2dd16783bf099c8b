// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/isolability.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace bondlab::diagnose {

namespace {

using Group = std::vector<std::string>;

bool holds(const Group &group, const std::string &name) {
  return std::find(group.begin(), group.end(), name) != group.end();
}

// Effects any two of which are taken for one another; each is in one group at most.
std::vector<Group> groups_of(const std::vector<Confusable> &pairs) {
  std::vector<std::string> names;
  std::set<std::pair<std::string, std::string>> alike;
  for (const auto &pair : pairs) {
    if (pair.chance < one_for_another) continue;
    alike.insert({pair.first, pair.second});
    alike.insert({pair.second, pair.first});
    for (const auto *name : {&pair.first, &pair.second})
      if (!holds(names, *name)) names.push_back(*name);
  }
  std::sort(names.begin(), names.end());
  std::vector<Group> groups;
  std::set<std::string> placed;
  for (const auto &name : names) {
    if (placed.count(name) > 0) continue;
    Group group = {name};
    for (const auto &other : names)
      if (placed.count(other) == 0 && !holds(group, other) &&
          std::all_of(group.begin(), group.end(), [&](const std::string &member) {
            return alike.count({member, other}) > 0;
          }))
        group.push_back(other);
    if (group.size() < least_group) continue;
    placed.insert(group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace

std::vector<std::string> isolability_lines(const std::vector<Confusable> &pairs) {
  const auto groups = groups_of(pairs);
  std::vector<std::string> lines;
  for (const auto &group : groups)
    lines.push_back(fmt::format("any two of {} effects, confused {:.0f} % and more: {}",
                                group.size(), 100 * one_for_another, fmt::join(group, ", ")));
  std::size_t told = 0, left = 0;
  for (const auto &pair : pairs) {
    const bool within = std::any_of(groups.begin(), groups.end(), [&](const Group &group) {
      return holds(group, pair.first) && holds(group, pair.second);
    });
    if (within) continue;
    if (++told > most_pairs_told) {
      ++left;
      continue;
    }
    lines.push_back(fmt::format("{} / {}: cosine {:.2f}, confused {:.0f} %", pair.first,
                                pair.second, pair.cosine, 100 * pair.chance));
  }
  if (left > 0) lines.push_back(fmt::format("and {} pairs more", left));
  return lines;
}

}  // namespace bondlab::diagnose
