// SPDX-License-Identifier: LGPL-2.1-or-later
// A quarter of a connecting rod (y > 0, z > 0) with the pin in its small eye, in mm.
// The pin touches the eye at (-10, 0) on the side of the shank.
//   gmsh -3 connecting-rod.geo -o connecting-rod.msh
SetFactory("OpenCASCADE");
pin = 9.99; eye = 10; outer = 16; crank = 20; crank_outer = 28; length = 80;
half = 8; pin_half = 18;
clearance = eye - pin;

Cylinder(1) = {0, 0, 0, 0, 0, half, outer, Pi};
Cylinder(2) = {-length, 0, 0, 0, 0, half, crank_outer, Pi};
Box(3) = {-length, 0, 0, length, 9, half - 2};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Cylinder(5) = {0, 0, 0, 0, 0, half, eye, Pi};
Cylinder(6) = {-length, 0, 0, 0, 0, half, crank, Pi};
BooleanDifference(7) = { Volume{4}; Delete; }{ Volume{5, 6}; Delete; };

// The end of the pin is in the piston, which presses on it.
Cylinder(10) = {-clearance, 0, 0, 0, 0, half + 1, pin, Pi};
Cylinder(11) = {-clearance, 0, half + 1, 0, 0, pin_half - half - 1, pin, Pi};
Cylinder(12) = {-clearance, 0, 0, 0, 0, pin_half, 5, Pi};
BooleanDifference{ Volume{10, 11}; Delete; }{ Volume{12}; Delete; }
BooleanFragments{ Volume{10, 11}; Delete; }{ }

e = 0.001;
q = pin + e;
eye() = Surface In BoundingBox{-eye - e, -e, -e, eye + e, eye + e, half + e};
eye() -= Surface In BoundingBox{-eye - e, -e, -e, eye + e, eye + e, e};
crank() = Surface In BoundingBox{-length - crank - e, -e, -e, -length + crank + e, crank + e, half + e};
// Surfaces of the pin around: without its hole, planes of symmetry and ends.
Function around
  out() = Surface In BoundingBox{-clearance - q, -e, low - e, -clearance + q, q, high + e};
  out() -= Surface In BoundingBox{-clearance - 5 - e, -e, low - e, -clearance + 5 + e, 5 + e, high + e};
  out() -= Surface In BoundingBox{-clearance - q, -e, low - e, -clearance + q, e, high + e};
  out() -= Surface In BoundingBox{-clearance - q, -e, low - e, -clearance + q, q, low + e};
  out() -= Surface In BoundingBox{-clearance - q, -e, high - e, -clearance + q, q, high + e};
Return
low = 0; high = half + 1;
Call around;
pin() = out();
low = high; high = pin_half;
Call around;

Physical Volume("rod") = {7};
Physical Volume("pin") = {10, 11};
Physical Surface("eye") = eye();
Physical Surface("crank") = crank();
Physical Surface("pin") = pin();
Physical Surface("boss") = out();
Physical Surface("y = 0") = Surface In BoundingBox{-200, -e, -e, 200, e, 200};
Physical Surface("z = 0") = Surface In BoundingBox{-200, -e, -e, 200, 200, e};

Mesh.MeshSizeMax = 5;
MeshSize{:} = 5;
Field[1] = Cylinder;
Field[1].Radius = 12;
Field[1].XCenter = -4;
Field[1].ZAxis = 2 * half;
Field[1].VIn = 2.6;
Field[1].VOut = 5;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = 5;
Mesh.ElementOrder = 2;
Mesh.MshFileVersion = 2.2;
