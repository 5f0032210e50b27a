% The Chaplygin sleigh by Octave's ode45, with equations derived by hand: to T = 10 at the tolerance at which its error is that of nhsym.
% Prints the error against phi = 2 k atan(tanh(omega0 t / (2 k))), after the milliseconds of the integration alone.
a = 1; k = 2;
f = @(t, z) [z(4); z(5) * cos(z(1)); z(5) * sin(z(1)); -z(4) * z(5) / (a * k^2); a * z(4)^2];
options = odeset("RelTol", 1e-10, "AbsTol", 1e-13);
tic;
[t, z] = ode45(f, [0 10], [0; 0; 0; 2; 0], options);
seconds = toc;
error_found = abs(z(end, 1) - 4 * atan(tanh(2 * 10 / 4)));
assert(error_found < 1e-8);
printf("%.2f %.1e\n", 1e3 * seconds, error_found);
