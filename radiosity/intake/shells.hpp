// SPDX-License-Identifier: MIT
#pragma once

// What the closed shells of a model are: solids, rooms, cavities of a solid around them, or one of two sides of the same walls. Orientation
// alone does not tell, for half of the models in the world are inside out here or there; lamps, eyes, and what lies in what tell more.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>

#include <radiosity/intake/polygons.hpp>
#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity::intake {

// nothing: the other side of walls that are there already.
enum class Role : unsigned char { surface, solid, room, cavity, nothing };

// Faces that hang together.
struct Component {
  std::vector<std::uint32_t> faces;
  raycast::Box box;
  bool closed = true;
  double volume = 0.0;  // of a closed one; negative when it looks inwards
  Role role = Role::surface;
  bool several = false;                 // of several groups
  bool one_sided = false;               // of a surface: its backs are not seen, for it encloses something, or lies on something
  bool both_sides = false;              // of a surface: both are seen (open_surfaces.hpp)
  bool flush = false;                   // a lamp that lies on something (lamps.hpp)
  std::vector<std::uint32_t> cavities;  // of a solid: the rooms in it, as components
};

class Shells {
 public:
  Shells(Working& mesh, const Topology& topology, std::span<const Material> materials, const IntakeOptions& options);

  // Tells what each component is, and turns shells that look the wrong way; what is turned or left out counts as a change.
  void find_roles();

  [[nodiscard]] std::span<const Component> components() const { return components_; }
  [[nodiscard]] bool shines(const Component& shell) const;
  // The component is a lamp that lies on a surface. `turn`: away from that. `one_sided`: what looks into it is not seen.
  void lay_lamp(std::uint32_t component, bool turn, bool one_sided);
  void turn(std::uint32_t component);
  // Of a surface its front alone is seen, or its back alone, which then is its front.
  void show_one_side(std::uint32_t component, bool back);
  void show_both_sides(std::uint32_t component) { components_[component].both_sides = true; }

  [[nodiscard]] std::span<const Room> rooms() const { return rooms_; }
  [[nodiscard]] bool turned(std::uint32_t component) const { return !turned_.empty() && turned_[component]; }

 private:
  // Shells of the same place, of which one looks outwards and one inwards: walls that were given twice, for both sides.
  struct Twins {
    Component *outer = nullptr, *inner = nullptr;
  };
  // A point that must be seen, on either side of a lamp that may lie on a wall.
  struct Place {
    glm::dvec3 front{0.0}, behind{0.0};
  };

  [[nodiscard]] std::vector<Twins> find_twins();
  // One side of the walls is seen; the other stays where it is neither clear that all lies within, nor that nothing does.
  void settle(const Twins& twins);
  // The part of all directions from the point in which the shell is seen from behind: 1 inside, 0 outside (van Oosterom, Strackee 1983).
  [[nodiscard]] bool holds(const Component& shell, const glm::dvec3& point) const;
  // The innermost shell that holds all these points. What lies on a shell is in it when its front is; or, of a shell that looks inwards,
  // when its back is.
  // A closed lamp that lies on a shell is in it when one of the two is.
  [[nodiscard]] Component* innermost(std::span<const Place> places, const Component* but);
  // Do six planes hold two fifths of its area, as walls, floor and ceiling do?
  [[nodiscard]] bool has_walls(const Component& shell) const;
  // The shell that looks inwards at all the others, which do not look inwards themselves, as in a model that is inside out. Open surfaces
  // alone, such as eyes and teeth in the head of a statue that is inside out, make no room of what has no walls. Null: none.
  [[nodiscard]] Component* shell_around_others();
  // The smallest shell that holds this one, or none.
  [[nodiscard]] std::uint32_t around(const Component& shell) const;
  // What lies in what, and how much of it that fills. Nothing where there are too many shells.
  struct Nest {
    std::vector<std::uint32_t> inner;  // the shells in it, but not those in these
    double filled = 0.0;               // share of the volume
  };
  void find_nests();
  // Rooms that no lamp and no eye tells of. What fills at least half of a shell is no furniture: that shell is walls, and what looks the
  // other way in it, or has things in it, is a room. Where less is filled, a shell that looks outwards at things which all look inwards is
  // a room of a model that is inside out; this only where no other room is known.
  void find_nested_rooms(bool room_known);
  // Another shell as a whole; where no shell is around both, its middle is enough.
  [[nodiscard]] bool holds_another(const Component& shell, const Component* around) const;
  // Does the shell hold things that look the other way, as those of a room do, and that leave half of it free, so that it is not the outer
  // side of walls?
  [[nodiscard]] bool is_furnished(const Component& shell) const;
  // May the shell be a room in which nothing stands? It has walls, does not look outwards as far as the file tells, nothing but lamps
  // reaches out of it, and no eye tells another thing.
  [[nodiscard]] bool is_bare_room(const Component& shell) const;
  // The innermost furnished or bare room through whose walls a lamp reaches, such as a bulb that is sunk into the ceiling. `lamp` is null
  // where it is none of the shells.
  [[nodiscard]] Component* pierced_by(std::span<const Place> places, const Component* lamp);
  // Is a shell that shines on the inside, at least in part, a room? One that looks outwards is when it shines in part and is furnished. One
  // that looks inwards is when something is in it, when it is alone, or when the innermost shell around it looks outwards and is filled by
  // half, as walls are by their rooms. Else it is a lamp, a bulb for instance, or a thing that shines, and is inside out; so it is when an
  // eye in the shell around it tells that this is the room.
  [[nodiscard]] bool shines_inwards(const Component& lamp, const Component* around, bool around_is_room) const;
  // Shells around lamps and eyes. Some may be null.
  [[nodiscard]] std::vector<Component*> find_rooms();
  void turn_shells();
  // Walls with a thickness: the room is a cavity of the solid around it.
  void hollow_solids();
  // Walls, floor and ceiling of several groups stay objects of these groups: rooms become surfaces, and so do the shells whose walls or
  // cavities they are. A thing of several groups, such as a cabinet in parts by material, is one solid: what it stands on is buried there.
  void part_groups();

  Working& mesh_;
  std::span<const Material> materials_;
  const IntakeOptions& options_;
  std::vector<Component> components_;
  std::vector<Nest> nests_;   // of a component
  std::vector<bool> turned_;  // of a component
  std::vector<Room> rooms_;
  raycast::Box bounds_;
};

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/shell_rooms.cpp>
#include <radiosity/intake/shells.cpp>
#endif
