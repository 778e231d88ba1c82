#pragma once
/// Keys of cloth of springs, which garments and sheets share.

#include <utility>

#include "cases/cloth/kind.hpp"
#include "cases/input/table.hpp"

namespace gambeson::schema {

Object springsTable();

/// Adds the key to the table of a T whose member `cloth` is a ClothModel.
template <class T>
void addSpringFields(Table<T>& table) {
  table
      .object(
          "springs", [](auto& t) -> auto& { return t.cloth.springs; }, springsTable(),
          "of model springs: how stiff they are, in place of what the fabric says")
      .defaultsTo("all from the fabric");
}

}  // namespace gambeson::schema
