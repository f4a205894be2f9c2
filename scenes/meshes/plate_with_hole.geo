// A unit square with a round hole of radius 0.2, quadrilaterals of size h, with collars of width
// delta around it and in the hole.
DefineConstant[ h = 0.1, delta = 0.1 ];

r = 0.2;
w = delta + h;
s = 2 * h; // of the cells that are then cut into quadrilaterals
Point(1) = {0, 0, 0, s};
Point(2) = {1, 0, 0, s};
Point(3) = {1, 1, 0, s};
Point(4) = {0, 1, 0, s};
Point(5) = {-w, -w, 0, s};
Point(6) = {1 + w, -w, 0, s};
Point(7) = {1 + w, 1 + w, 0, s};
Point(8) = {-w, 1 + w, 0, s};
Point(9) = {.5, .5, 0, s};
For k In {0:3}
  Point(10 + k) = {.5 + r * Cos(k * Pi / 2), .5 + r * Sin(k * Pi / 2), 0, s};
EndFor
For k In {0:3}
  Line(1 + k) = {1 + k, 1 + (k + 1) % 4};
  Line(5 + k) = {5 + k, 5 + (k + 1) % 4};
  Circle(9 + k) = {10 + k, 9, 10 + (k + 1) % 4};
EndFor
Curve Loop(1) = {1:4};
Curve Loop(2) = {5:8};
Curve Loop(3) = {9:12};
Plane Surface(1) = {1, 3};
Plane Surface(2) = {2, 1};
Plane Surface(3) = {3};
Physical Surface("omega") = {1};
Physical Surface("collar") = {2, 3};
Mesh.SubdivisionAlgorithm = 1; // quadrilaterals alone
Recombine Surface{:};
