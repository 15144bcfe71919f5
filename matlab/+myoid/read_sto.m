function data = read_sto(file)
  % READ_STO  Reads a .sto or .mot file.
  %   data = myoid.read_sto('results/lift/ik.mot')
  % data.names: channels; data.time: n x 1 [s]; data.values: n x channels, as the file holds them; data.in_degrees;
  % data.title. In MATLAB data.table is a table with the column time first.
  % Every row must have a number for every column: an error names the line of a row with another count or with a cell
  % that is no number. Files with several numbers in a cell (Vec3, Quaternion) are not read.
  lines = strsplit(strrep(fileread(file), char(13), ''), char(10));
  head = find(strcmpi(strtrim(lines), 'endheader'), 1);
  if isempty(head)
    error('myoid:badInput', '%s: there is no line endheader; a .sto or .mot file has one', file);
  end
  keys = header_keys(lines(1:head), file);
  data.title = strtrim(lines{1});
  data.in_degrees = keys.in_degrees;
  filled = find(~cellfun(@isempty, strtrim(lines)));
  filled = filled(filled > head);
  if isempty(filled)
    error('myoid:badInput', '%s: the file ends after its header; expected the column labels', file);
  end
  columns = labels_of(lines{filled(1)});
  rows = filled(2:end);
  numbers = numbers_of(lines, rows, numel(columns), file);
  if ~isnan(keys.rows) && keys.rows ~= size(numbers, 1)
    warning('myoid:rowCount', '%s: the header says %d rows, there are %d; is the file cut off?', file, keys.rows, ...
            size(numbers, 1));
  end
  back = find(diff(numbers(:, 1)) <= 0, 1);
  if ~isempty(back)
    error('myoid:badInput', '%s:%d: time does not increase: %g s after %g s', file, rows(back + 1), ...
          numbers(back + 1, 1), numbers(back, 1));
  end
  data.names = columns(2:end);
  data.time = numbers(:, 1);
  data.values = numbers(:, 2:end);
  if exist('array2table', 'file') == 2 && ~exist('OCTAVE_VERSION', 'builtin')
    data.table = array2table(numbers, 'VariableNames', matlab.lang.makeUniqueStrings( ...
                                                           matlab.lang.makeValidName(columns)));
  end
end

function keys = header_keys(lines, file)
  % The statements of the header: number of rows (NaN where it is not stated) and whether angles are in degrees.
  keys = struct('rows', NaN, 'in_degrees', false);
  stated = false;
  version = 0;
  for k = 1:numel(lines)
    pair = regexp(strtrim(lines{k}), '^(\w+)(?:\s*=\s*|\s+)(\S+)$', 'tokens', 'once');
    if numel(pair) ~= 2
      continue
    end
    value = pair{2};
    switch lower(pair{1})
      case {'nrows', 'datarows'}
        keys.rows = str2double(value);
      case 'version'
        version = str2double(value);
      case 'datatype'
        if ~strcmpi(value, 'double')
          error('myoid:badInput', '%s:%d: cells of type %s are not read; expected double', file, k, value);
        end
      case 'indegrees'
        stated = true;
        if any(strcmpi(value, {'yes', 'y', 'true', '1'}))
          keys.in_degrees = true;
        elseif ~any(strcmpi(value, {'no', 'n', 'false', '0'}))
          error('myoid:badInput', '%s:%d: inDegrees: found ''%s'', expected yes or no', file, k, value);
        end
    end
  end
  % A .mot without a version is of SIMM's kind, with angles in degrees, as for the program.
  if ~stated && ~(version >= 1) && numel(file) > 4 && strcmpi(file(end - 3:end), '.mot')
    keys.in_degrees = true;
  end
end

function columns = labels_of(line)
  line = strtrim(line);
  columns = regexp(line, '\t', 'split');
  if numel(columns) == 1
    columns = regexp(line, '\s+', 'split');
  end
  columns = strtrim(columns);
end

function numbers = numbers_of(lines, rows, columns, file)
  % Reads all rows at once, and line by line only where the count is wrong.
  if isempty(rows)
    error('myoid:badInput', '%s: there are no rows of numbers after the column labels', file);
  end
  body = lines(rows);
  words = cellfun(@numel, regexp(body, '\S+', 'start'));
  numbers = [];
  if all(words == columns)
    numbers = sscanf(strjoin(body, char(10)), '%f');
  end
  if numel(numbers) ~= numel(rows) * columns
    for k = 1:numel(rows)
      require_row(body{k}, columns, file, rows(k));
    end
    error('myoid:badInput', '%s: found %d numbers, expected %d in %d rows', file, numel(numbers), columns, numel(rows));
  end
  numbers = reshape(numbers, columns, [])';
end

function require_row(line, columns, file, number)
  % Raises an error unless a line holds as many numbers as there are columns.
  words = regexp(strtrim(line), '\s+', 'split');
  if numel(words) ~= columns
    error('myoid:badInput', '%s:%d: expected %d numbers, found %d; the row is cut off or a cell is empty', file, number, ...
          columns, numel(words));
  end
  for c = 1:columns
    [~, count, ~, next] = sscanf(words{c}, '%f', 1);
    if count ~= 1 || next <= numel(words{c})
      error('myoid:badInput', '%s:%d: column %d: expected a number, found ''%s''', file, number, c, words{c});
    end
  end
end
