// A disk of radius 1 that holds another material within radius 0.5, sides of the mesh along the
// interface, and a collar of width delta.
DefineConstant[ h = 0.1, delta = 0.3 ];

outer = 1 + delta + h;
Point(1) = {0, 0, 0, h};
For k In {0:3}
  Point(2 + k) = {Cos(k * Pi / 2), Sin(k * Pi / 2), 0, h};
  Point(6 + k) = {outer * Cos(k * Pi / 2), outer * Sin(k * Pi / 2), 0, h};
  Point(10 + k) = {Cos(k * Pi / 2) / 2, Sin(k * Pi / 2) / 2, 0, h};
EndFor
For k In {0:3}
  Circle(1 + k) = {2 + k, 1, 2 + (k + 1) % 4};
  Circle(5 + k) = {6 + k, 1, 6 + (k + 1) % 4};
  Circle(9 + k) = {10 + k, 1, 10 + (k + 1) % 4};
EndFor
Curve Loop(1) = {1:4};
Curve Loop(2) = {5:8};
Curve Loop(3) = {9:12};
Plane Surface(1) = {1, 3};
Plane Surface(2) = {2, 1};
Plane Surface(3) = {3};
Physical Surface("omega_matrix") = {1};
Physical Surface("omega_inclusion") = {3};
Physical Surface("collar") = {2};
