function with_loadlibrary(results)
  % WITH_LOADLIBRARY  Torques of an identified person in MATLAB (Octave has no loadlibrary): with_loadlibrary('results')
  loadlibrary('libmyoid', 'myoid.h');
  close_it = onCleanup(@() unloadlibrary('libmyoid'));
  [model, ~, ~, said] = calllib('libmyoid', 'myoid_open', results, [], blanks(1000), 1000);
  if isNull(model)
    error('myoid:badInput', '%s', strtrim(said));
  end
  workspace = calllib('libmyoid', 'myoid_workspace_new', model);
  channels = calllib('libmyoid', 'myoid_channel_count', model);
  joints = calllib('libmyoid', 'myoid_joint_count', model);
  envelope = libpointer('doublePtr', 0.2 * ones(1, channels));
  acting = libpointer('doublePtr', zeros(1, channels));
  torque = libpointer('doublePtr', zeros(1, joints));
  place = libstruct('myoid_output', struct('size', 56, 'torque_nm', torque));  % 56: seven words of 64 bits
  calllib('libmyoid', 'myoid_follow', model, workspace, envelope, 0.001, acting);
  angle = 0.5 * ones(1, joints);  % [rad]
  speed = 0.5 * ones(1, joints);  % [rad/s]
  code = calllib('libmyoid', 'myoid_evaluate', model, workspace, acting, angle, speed, place);
  fprintf('code %d: %s N m\n', code, mat2str(torque.Value, 4));
  calllib('libmyoid', 'myoid_workspace_free', workspace);
  calllib('libmyoid', 'myoid_close', model);
end
