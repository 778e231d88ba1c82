#pragma once
/// Keys of cloth of nodes, springs and the degenerated shell, which garments and sheets share.

#include <utility>

#include "cases/cloth/kind.hpp"
#include "cases/input/table.hpp"

namespace gambeson::schema {

Object springsTable();
Object shellTable();

/// Adds the keys to the table of a T whose member `cloth` is a ClothModel.
template <class T>
void addNodeFields(Table<T>& table) {
  table
      .object(
          "springs", [](auto& t) -> auto& { return t.cloth.springs; }, springsTable(),
          "of model springs: how stiff they are, in place of what the fabric says")
      .defaultsTo("all from the fabric")
      .object(
          "shell", [](auto& t) -> auto& { return t.cloth.shell; }, shellTable(), "of model shell: how it integrates")
      .defaultsTo("its defaults");
}

}  // namespace gambeson::schema
