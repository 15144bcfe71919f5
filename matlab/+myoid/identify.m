function result = identify(out, varargin)
  % IDENTIFY  Muscle parameters straight from files.
  %   result = myoid.identify('results', 'muscles', 'muscles.csv', 'activations', {'a1.sto', 'a2.sto'}, ...
  %                           'lengths', {...}, 'velocities', {...}, 'moment_arms', {...}, 'torques', {...})
  % Options are those of `myoid identify --help`, with _ for -. Returns the table of parameters (read_parameters).
  myoid.call('identify', {}, 'out', out, 'quiet', true, varargin{:});
  result = myoid.read_parameters(out);
end
