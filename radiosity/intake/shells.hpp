// SPDX-License-Identifier: MIT
#pragma once

// Classifies the closed shells of a model: solids, rooms, cavities of a solid around them, or one of two sides of the same walls.
// Orientation alone does not decide, because many models are partly inside out. Lamps, eyes, and which shell contains which tell more.

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

// nothing: a shell that duplicates walls which are already there, and is left out.
enum class Role : unsigned char { surface, solid, room, cavity, nothing };

// A set of connected faces.
struct Component {
  std::vector<std::uint32_t> faces;
  raycast::Box box;
  bool closed = true;
  double volume = 0.0;  // of a closed one; negative if it looks inwards
  Role role = Role::surface;
  bool several = false;                 // do its faces belong to several groups?
  bool one_sided = false;               // of a surface: its back is not visible, because it encloses or lies on something
  bool both_sides = false;              // of a surface: both sides are visible (open_surfaces.hpp)
  bool flush = false;                   // it lies or stands on something (lamps.hpp, decals.hpp)
  std::vector<std::uint32_t> cavities;  // of a solid: the components that are its cavities
};

class Shells {
 public:
  Shells(Working& mesh, const Topology& topology, std::span<const Material> materials, const IntakeOptions& options);

  // Finds the role of each component and turns shells with the wrong orientation. Counts what is turned or left out as changes.
  void find_roles();

  [[nodiscard]] std::span<const Component> components() const { return components_; }
  [[nodiscard]] bool shines(const Component& shell) const;           // does any face of it?
  [[nodiscard]] double shining_share(const Component& shell) const;  // of its area
  // Marks the component as one that lies on a surface. `turn`: does it show the back of its faces? `one_sided`: its side towards that
  // surface is not visible.
  void lay(std::uint32_t component, bool turn, bool one_sided = true);
  void turn(std::uint32_t component);
  // Makes only the front of a surface visible, or only its back, which then becomes its front.
  void show_one_side(std::uint32_t component, bool back);
  void show_both_sides(std::uint32_t component) { components_[component].both_sides = true; }
  // Makes it a later object than what it stands on, so that it is seen where both coincide.
  void show_before_others(std::uint32_t component) { components_[component].flush = true; }

  [[nodiscard]] std::span<const Room> rooms() const { return rooms_; }
  [[nodiscard]] bool turned(std::uint32_t component) const { return !turned_.empty() && turned_[component]; }

 private:
  // Two shells at the same place, one looking outwards and one inwards: walls that were given twice, once for each side.
  struct Twins {
    Component *outer = nullptr, *inner = nullptr;
  };
  // A point that must be visible: its places in front of and behind the lamp, which may lie on a wall.
  struct Place {
    glm::dvec3 front{0.0}, behind{0.0};
  };

  [[nodiscard]] std::vector<Twins> find_twins();
  // Keeps one of the two sides. Keeps both if the model lies neither clearly all inside nor clearly all outside.
  void settle(const Twins& twins);
  // Does the closed shell contain the point? Computed from the solid angle of its faces (van Oosterom, Strackee 1983): the fraction of
  // all directions in which it is seen from behind is 1 inside and 0 outside.
  [[nodiscard]] bool holds(const Component& shell, const glm::dvec3& point) const;
  // The innermost shell, except `but`, that contains all these points. A point on a shell is inside if its front place is; for a shell
  // that looks inwards, if its back place is. A closed lamp on a shell is inside if one of the two is.
  [[nodiscard]] Component* innermost(std::span<const Place> places, const Component* but);
  // Do six planes hold two fifths of its area, like walls, floor and ceiling?
  [[nodiscard]] bool has_walls(const Component& shell) const;
  // The shell that looks inwards at all other shells, of which at most a third look inwards themselves: of a model that is inside out, most
  // do. Null: none. Open surfaces alone, such as eyes and teeth in the head of a statue that is inside out, do not make a shell without
  // walls a room.
  [[nodiscard]] Component* shell_around_others();
  // The smallest shell that contains this one, or none.
  [[nodiscard]] std::uint32_t around(const Component& shell) const;
  // The shells directly inside a shell, and how much of its volume they fill. Empty if there are too many shells.
  struct Nest {
    std::vector<std::uint32_t> inner;  // the shells in it, without those nested in these
    double filled = 0.0;               // share of the volume
  };
  void find_nests();
  // Finds rooms in which there is no lamp and no eye. If a shell is filled by at least half, it is walls rather than furnished, and a
  // shell in it that looks the other way, or contains something, is a room. If it is filled less, a shell that looks outwards and
  // contains only shells that look inwards is a room of a model that is inside out; this is used only if no other room is known.
  void find_nested_rooms(bool room_known);
  // As holds(), for another shell as a whole; if no shell contains both, its centre is enough, unless it is larger than a shell that shines
  // all over, as the shade around a bulb is.
  [[nodiscard]] bool holds_another(const Component& shell, const Component* around) const;
  // Does the shell contain shells that look the other way, as furniture does in a room, and that leave half of it free, so that it is not
  // the outer side of walls?
  [[nodiscard]] bool is_furnished(const Component& shell) const;
  // May the shell be an empty room? It has walls, does not look outwards according to the file, nothing but lamps sticks out of it, and
  // no eye tells otherwise.
  [[nodiscard]] bool is_bare_room(const Component& shell) const;
  // The innermost furnished or empty room through whose walls a lamp reaches, such as a bulb sunk into the ceiling. `lamp`: null if the
  // lamp is not a shell.
  [[nodiscard]] Component* pierced_by(std::span<const Place> places, const Component* lamp);
  // The smallest shell around a shell that looks outwards and holds a lamp, as a globe or a housing does: that is the room, and the shell
  // a thing in it, if an eye is in that room; without any eye, if the shell itself shines. Null: none.
  [[nodiscard]] Component* room_of_thing(const Component& thing);
  // The distance from a place, in front of it (`ahead`) or behind it, to the first face of a component other than these; infinite if there
  // is none.
  [[nodiscard]] double way(const Place& place, bool ahead, std::span<const Component* const> but);
  // Does an open lamp lie on the outside of the shell, as on a ceiling that is a slab, although the lamp's front looks into the shell? The
  // shell looks outwards, holds nothing but lamps, and is at most half as thick there as the way from the lamp's back to another shell.
  [[nodiscard]] bool lies_outside(const Component& shell, const Component& lamp, std::span<const Place> places);
  // Is a shell that emits inwards, at least in part, a room? One that looks outwards is a room if it emits only in part and is furnished.
  // One that looks inwards is a room if something is in it, if it is the only shell, or if the innermost shell around it looks outwards
  // and is half filled, as walls are by their rooms. Otherwise it is a lamp, such as a bulb, or another emitting object that is inside
  // out; it is also one if an eye in the shell around it shows that the outer shell is the room.
  [[nodiscard]] bool shines_inwards(const Component& lamp, const Component* around, bool around_is_room) const;
  // A component that emits, and its emitting faces.
  struct Lamp {
    struct BrightFace {
      std::uint32_t face;
      glm::dvec3 middle;
      double area;
    };
    Component* component;
    glm::dvec3 middle;
    double area;  // of the emitting faces
    std::vector<BrightFace> bright;
  };
  [[nodiscard]] std::vector<Lamp> lamps();  // the largest 64
  // The shells around lamps and eyes. Some entries may be null.
  [[nodiscard]] std::vector<Component*> find_rooms();
  void turn_shells();
  // For walls with a thickness: makes the room a cavity of the solid around it.
  void hollow_solids();
  // Walls, floor and ceiling that belong to several groups stay objects of these groups: such rooms become surfaces, and so do shells
  // whose walls or cavities they are. An object of several groups, such as a cabinet divided by material, becomes one solid, so that
  // surfaces between it and what it stands on are buried.
  void part_groups();

  Working& mesh_;
  std::span<const Material> materials_;
  const IntakeOptions& options_;
  std::vector<Component> components_;
  std::vector<Nest> nests_;   // by component
  std::vector<bool> turned_;  // by component
  std::vector<Room> rooms_;
  raycast::Box bounds_;
};

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/shell_rooms.cpp>
#include <radiosity/intake/shells.cpp>
#endif
