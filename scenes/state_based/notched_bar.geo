// A bar 1 x 0.5 with a round notch of radius 0.1 in its upper side, in three parts: where it is held,
// its middle, and where it is pulled. The triangles do not depend on h: they are the outline that cuts
// the lattice, and the mesh of the reference, whose degree makes it accurate.
s = 0.15; // of the triangles
n = 0.08; // of those at the notch
Point(1) = {0, 0, 0, s};
Point(2) = {.2, 0, 0, s};
Point(3) = {.8, 0, 0, s};
Point(4) = {1, 0, 0, s};
Point(5) = {1, .5, 0, s};
Point(6) = {.8, .5, 0, s};
Point(7) = {.6, .5, 0, n};
Point(8) = {.5, .5, 0, s}; // the notch's centre
Point(9) = {.5, .4, 0, n};
Point(10) = {.4, .5, 0, n};
Point(11) = {.2, .5, 0, s};
Point(12) = {0, .5, 0, s};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Circle(7) = {7, 8, 9};
Circle(8) = {9, 8, 10};
Line(9) = {10, 11};
Line(10) = {11, 12};
Line(11) = {12, 1};
Line(12) = {2, 11};
Line(13) = {3, 6};
Curve Loop(1) = {1, 12, 10, 11};
Curve Loop(2) = {2, 13, 6, 7, 8, 9, -12};
Curve Loop(3) = {3, 4, 5, -13};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Physical Surface("omega") = {1, 2, 3};
