#pragma once
// A group of a process's parameters: a struct in its parameter struct, a heading in its recipes.
#include <string>
#include <utility>
#include <vector>

#include "core/parameter.h"

namespace windfall {

/// Adds the keys of one group to a table, each bound to a member of the group's struct.
template <class Parameters, class Group>
class ParameterGroup {
  public:
    ParameterGroup(ParameterTable<Parameters>& table, std::string name, Group Parameters::*group)
        : m_table(table), m_name(std::move(name)), m_group(group) {}

    template <class Value>
    void add(const std::string& key, const std::string& unit, Value Group::*member, const std::string& doc,
             const ParameterRange& range = {}) {
        m_table.add(
            m_name + "." + key, unit,
            [ group = m_group, member ](auto& p) -> auto& { return p.*group.*member; }, doc, range);
    }
    template <class Value>
    void add_choice(const std::string& key, Value Group::*member, const std::vector<std::string>& choices,
                    const std::string& doc) {
        m_table.add_choice(
            m_name + "." + key, [ group = m_group, member ](auto& p) -> auto& { return p.*group.*member; },
            choices, doc);
    }

  private:
    ParameterTable<Parameters>& m_table;
    std::string m_name;
    Group Parameters::*m_group;
};

}  // namespace windfall
